//! Writes the seeds of the target `checkpoint`: `cargo run --example checkpoint_seeds` in `fuzz/`.

use std::{fs, io};

use radiosity_core::{Control, Kept, Observer, StepReport};
use radiosity_fuzz::Work;

#[path = "../../crates/cli/src/checkpoint/container.rs"]
#[expect(dead_code, reason = "only what writes is needed here")]
mod container;

/// The file of every step.
#[derive(Default)]
struct Files(Vec<Vec<u8>>);

impl Observer for Files {
    fn step(&mut self, _: &StepReport) -> Control {
        Control::Continue
    }

    fn keeps(&mut self) -> bool {
        true
    }

    fn keep(&mut self, kept: &Kept<'_>) {
        let mut file = Vec::new();
        container::write(&mut file, "program: fuzz\n", |out| kept.write(out))
            .expect("a vector takes everything");
        self.0.push(file);
    }
}

fn main() -> io::Result<()> {
    let mut files = Files::default();
    let refined = Work::new().solve(&mut files);
    let steps = files.0.len();
    println!("{steps} steps, {} elements, {:?}", refined.mesh.elements().len(), refined.reached);
    fs::create_dir_all("seeds/checkpoint")?;
    // The first step, one amid the work, and the last one.
    for step in [0, steps / 2, steps - 1] {
        fs::write(format!("seeds/checkpoint/{step}.ckpt"), &files.0[step])?;
    }
    Ok(())
}
