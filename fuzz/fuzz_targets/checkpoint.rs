//! Bytes as a checkpoint: the file around the state, and the state itself.

#![no_main]

use libfuzzer_sys::fuzz_target;
use radiosity_core::{Checkpoint, Control, Observer, StepReport};
use radiosity_fuzz::{Work, one_line};

// The program has no library: its file format is one file, which both compile.
#[path = "../../crates/cli/src/checkpoint/container.rs"]
#[expect(dead_code, reason = "examples/checkpoint_seeds.rs writes with it")]
mod container;

/// Bytes of the checksum at the end of a file.
const SUM: usize = 4;

fuzz_target!(|bytes: &[u8]| {
    if let Err(message) = container::parts(bytes) {
        one_line(&message);
    }
    // No mutation keeps the checksum, so it is put right.
    let (body, _) = bytes.split_at(bytes.len().saturating_sub(SUM));
    let file = [body, &crc32fast::hash(body).to_le_bytes()].concat();
    match container::parts(&file) {
        Ok((_, state)) => go_on(state),
        Err(message) => one_line(&message),
    }
});

/// What the program does with the state of a file.
fn go_on(state: &[u8]) {
    thread_local! {
        static WORK: Work = Work::new();
    }
    match Checkpoint::read(state) {
        Ok(checkpoint) => WORK.with(|work| {
            if let Err(error) = work.resume(checkpoint, &mut Brief(0)) {
                one_line(&error.to_string());
            }
        }),
        Err(error) => one_line(&error.to_string()),
    }
}

/// Stops soon: a state that makes no sense could shoot for long.
struct Brief(u32);

impl Observer for Brief {
    fn step(&mut self, _: &StepReport) -> Control {
        self.0 += 1;
        if self.0 < 3 { Control::Continue } else { Control::Stop }
    }
}
