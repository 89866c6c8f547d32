//! `radiosity compare`: how far two solutions are apart.

use std::fs::File;
use std::path::Path;

use output::csv;

use crate::args::CompareArgs;
use crate::failure::Failure;
use crate::files;
use crate::screen::result;
#[cfg(feature = "png")]
use crate::{screen, settings};

/// Prints E1, E2 and Einf per channel; the last column is the worst channel.
pub(crate) fn run(args: &CompareArgs) -> Result<(), Failure> {
    #[cfg(feature = "png")]
    check_picture(args)?;
    let ours = read(&args.ours)?;
    let reference = read(&args.reference)?;
    let c = output::compare(&ours, &reference).map_err(|e| {
        let pair = format!("{} and {}", args.ours.display(), args.reference.display());
        Failure::Failed(format!("{pair}: {e}"))
    })?;
    result("measure          r          g          b      worst")?;
    for (name, values, worst) in
        [("E1", c.e1, c.worst_e1()), ("E2", c.e2, c.worst_e2()), ("Einf", c.einf, c.worst_einf())]
    {
        row(name, values, worst)?;
    }
    if let Some(se) = c.reference_se {
        row("ref. se", se, se.into_iter().fold(0.0, f64::max))?;
    }
    result(&format!("over {} of {} rows", c.rows_used, reference.len()))?;
    #[cfg(feature = "png")]
    picture(args, &ours, &reference)?;
    match args.at_most {
        Some(most) if c.worst_e1() > most => Err(Failure::Failed(format!(
            "E1 is {:.6} in the worst channel, expected at most {most}",
            c.worst_e1()
        ))),
        _ => Ok(()),
    }
}

/// Draws both and their difference, if asked for.
#[cfg(feature = "png")]
fn picture(args: &CompareArgs, ours: &[csv::Row], reference: &[csv::Row]) -> Result<(), Failure> {
    let (Some(path), Some(file)) = (&args.picture, &args.scene) else {
        return match args.view.are_given() {
            true => Err(Failure::Usage("--camera, --size, --exposure: are for --picture".into())),
            false => Ok(()),
        };
    };
    let imported = scene_import::open(file, &scene_import::Options::default())?;
    let scene = &imported.scene;
    let options = settings::output_options(&args.view, scene)?;
    let mut range = 0.0;
    output::replace_file(path, |out| {
        range = output::difference::write(out, scene, ours, reference, &options, args.range)?;
        Ok(())
    })?;
    let range = screen::percent(range);
    screen::say(&format!("written: {}: A, B, and their difference to ±{range}", path.display()));
    Ok(())
}

/// Refuses names that cannot be pictures, and such as are read, before anything is read.
#[cfg(feature = "png")]
fn check_picture(args: &CompareArgs) -> Result<(), Failure> {
    let Some(path) = &args.picture else { return Ok(()) };
    if !path.extension().is_some_and(|e| e.eq_ignore_ascii_case("png")) {
        let message = format!("--picture {}: expected a name that ends in .png", path.display());
        return Err(Failure::Usage(message));
    }
    for read in [&args.ours, &args.reference].into_iter().chain(&args.scene) {
        files::check_apart(Some(read), &[path])?;
    }
    files::check(path)
}

fn row(name: &str, [r, g, b]: [f64; 3], worst: f64) -> Result<(), Failure> {
    result(&format!("{name:<8}{r:>11.6}{g:>11.6}{b:>11.6}{worst:>11.6}"))
}

fn read(path: &Path) -> Result<Vec<csv::Row>, Failure> {
    files::check_read(path)?;
    let file = File::open(path).map_err(|e| Failure::Failed(format!("{}: {e}", path.display())))?;
    Ok(csv::read(file).map_err(|e| e.at(path))?)
}
