//! `radiosity convert`: a scene file in another format, unlit.

use output::{ErrorKind, Format};
use tri_io::Writer;

use crate::args::{CONVERTED, ConvertArgs};
use crate::commands::solve;
use crate::failure::Failure;
use crate::screen::{self, Event, tell};
use crate::{files, settings};

/// Reads a scene and writes it again.
pub(crate) fn run(args: &ConvertArgs) -> Result<(), Failure> {
    let path = &args.output;
    let format = match Format::from_path(path) {
        Ok(format @ (Format::Tri | Format::Glb | Format::Ply)) => format,
        Err(error) if matches!(error.kind(), ErrorKind::FeatureOff(_)) => return Err(error.into()),
        _ => {
            let message = format!("{}: expected a name in {CONVERTED}", path.display());
            return Err(Failure::Usage(message));
        }
    };
    let read = settings::read(&args.read)?;
    files::check_apart(Some(&args.input), &[path])?;
    files::check(path)?;
    let (file, imported) = solve::open(Some(&args.input), &read)?;
    if format != Format::Tri {
        solve::check_factors(&file, &imported, &read)?;
    }
    tell(|| Event::scene(&file, &imported), &format!("{file}: {}", imported.summary));
    screen::diagnostics(&imported.diagnostics);
    let scene = &imported.scene;
    match format {
        Format::Tri => {
            let (records, losses) = scene_import::tri_records(scene, &read.options);
            for loss in &losses {
                screen::warning(&loss.to_string());
            }
            output::replace_file(path, |out| {
                let mut writer = Writer::new(out);
                for record in &records {
                    writer.write(record)?;
                }
                writer.finish()?;
                Ok(())
            })?;
        }
        _ => {
            let options = output::Options::default();
            output::write_file(path, scene, &output::unlit(scene), &options)?;
        }
    }
    let written = [path.display().to_string()];
    tell(|| Event::Written { files: &written }, &format!("written: {}", written[0]));
    Ok(())
}
