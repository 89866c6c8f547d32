//! `radiosity form-factors`: the form factors of a scene as a table.

mod report;

use std::path::{Path, PathBuf};
use std::time::Instant;

use form_factor::Occluders;
use output::matrix::{Format, Table, names_path};
use radiosity_core::Executor;
use radiosity_core::matrix::{
    Between, Closed, ComputeConfig, Computed, Defects, Matrix, Surfaces, compute,
};
use radiosity_par::Pool;
use scene::Scene;

use crate::failure::Failure;
use crate::files;
use crate::screen::{self, Event, count, say, seconds, tell};
use crate::settings::{FormFactors, TableTarget};
use report::Report;

/// What was found, and how long it took.
struct Found {
    between: Between,
    computed: Computed,
    /// The defects as computed, before any repair.
    raw: Defects,
    reciprocity: f64,
    closed: Option<Closed>,
    threads: usize,
    read_seconds: f64,
    compute_seconds: f64,
    output_seconds: f64,
}

/// Reads the scene, computes, writes, and says what was found.
pub(crate) fn run(settings: &FormFactors) -> Result<(), Failure> {
    check_files(settings)?;
    let clock = Instant::now();
    let imported = scene_import::open(&settings.scene, &settings.options)?;
    let read_seconds = clock.elapsed().as_secs_f64();
    let file = settings.scene.display().to_string();
    tell(|| Event::scene(&file, &imported), &format!("{file}: {}", imported.summary));
    screen::diagnostics(&imported.diagnostics);

    let scene = &imported.scene;
    let between = settings.between.unwrap_or_else(|| default_rows(scene));
    let surfaces = Surfaces::of_scene(scene, between);
    let pool = Pool::new(settings.threads)?;
    say_rows(settings, between, &surfaces, pool.threads());
    let clock = Instant::now();
    let triangles: Vec<_> = scene.ids().map(|id| scene.corners(id)).collect();
    let occluders = Occluders::build(&triangles);
    let config = ComputeConfig { tolerance: settings.tolerance, occluders: Some(&occluders) };
    let mut computed = compute(&surfaces, &config, &pool);
    let compute_seconds = clock.elapsed().as_secs_f64();

    let Some(raw) = computed.matrix.defects() else {
        let message = format!(
            "{}: has no surface with area, expected a triangle at least whose corners are apart",
            settings.scene.display()
        );
        return Err(Failure::Failed(message));
    };
    let reciprocity = computed.matrix.asymmetry();
    say_found(&computed, &raw, reciprocity);
    let closed = settings.close.then(|| close(&mut computed.matrix)).transpose()?;

    let clock = Instant::now();
    let outputs = write(&settings.outputs, &computed.matrix)?;
    let output_seconds = clock.elapsed().as_secs_f64();
    let found = Found {
        between,
        computed,
        raw,
        reciprocity,
        closed,
        threads: pool.threads(),
        read_seconds,
        compute_seconds,
        output_seconds,
    };
    let mut written = outputs.clone();
    if let Some(path) = &settings.report {
        Report::of(settings, &imported, &found, outputs).write(path)?;
        written.push(path.display().to_string());
    }
    say(&format!(
        "time: read {}, form factors {}, output {}",
        seconds(found.read_seconds),
        seconds(found.compute_seconds),
        seconds(found.output_seconds)
    ));
    tell(|| Event::Written { files: &written }, &format!("written: {}", written.join(", ")));
    Ok(())
}

/// Refuses what cannot be written before any work is lost on it.
fn check_files(settings: &FormFactors) -> Result<(), Failure> {
    let mut paths: Vec<PathBuf> = Vec::new();
    for target in &settings.outputs {
        if let TableTarget::File(path, format) = target {
            paths.push(path.clone());
            paths.extend((*format == Format::Npy).then(|| names_path(path)));
        }
    }
    paths.extend(settings.report.clone());
    let paths: Vec<&Path> = paths.iter().map(PathBuf::as_path).collect();
    files::check_apart(Some(&settings.scene), &paths)?;
    paths.into_iter().try_for_each(files::check)?;
    files::check_read(&settings.scene)
}

/// Groups where the file tells some apart, else triangles.
fn default_rows(scene: &Scene) -> Between {
    if scene.groups().len() > 1 { Between::Groups } else { Between::Triangles }
}

fn say_rows(settings: &FormFactors, between: Between, surfaces: &Surfaces, threads: usize) {
    let why = match (settings.between, between) {
        (Some(_), _) => "",
        (None, Between::Groups) => " (the file names them; --between triangles for each)",
        (None, Between::Triangles) => " (the file has one group)",
    };
    let of = match between {
        Between::Groups => format!("groups of {} triangles", count(surfaces.polygons() as u64)),
        Between::Triangles => "triangles".into(),
    };
    let rows = count(surfaces.names().len() as u64);
    let threads = if threads == 1 { "1 thread".into() } else { format!("{threads} threads") };
    say(&format!("form factors between {rows} {of}{why}; {threads}"));
}

fn say_found(computed: &Computed, raw: &Defects, reciprocity: f64) {
    let matrix = &computed.matrix;
    let name = |row: usize| &matrix.names()[row];
    say(&format!(
        "{} pairs of triangles, {} of them exchange light; visibility computed for {}; {} integrand \
         values",
        count(computed.pairs),
        count(computed.lit),
        count(computed.visibility),
        count(computed.effort)
    ));
    let worst = raw.worst();
    say(&format!(
        "raw: rows sum to {:.9} ({:?}) to {:.9} ({:?}); the worst, {:?}, is {:.1e} from 1",
        raw.lowest.sum,
        name(raw.lowest.row),
        raw.highest.sum,
        name(raw.highest.row),
        name(worst.row),
        raw.closure()
    ));
    say(&format!(
        "raw: stated errors at most {:.1e} of one form factor, {:.1e} of a row; reciprocity to \
         {reciprocity:.0e}, because each pair is computed once",
        raw.error, raw.row_error
    ));
}

fn close(matrix: &mut Matrix) -> Result<Closed, Failure> {
    let closed = matrix.close().map_err(|e| Failure::Failed(format!("--close: {e}")))?;
    say(&format!(
        "closed: rows off by {:.1e} before and {:.1e} after; form factors changed by at most \
         {:.1e}, or {:.1e} of their value",
        closed.before, closed.after, closed.change, closed.relative_change
    ));
    Ok(closed)
}

fn write(targets: &[TableTarget], matrix: &Matrix) -> Result<Vec<String>, Failure> {
    let table = Table {
        names: matrix.names(),
        areas: matrix.areas(),
        starts: matrix.starts(),
        columns: matrix.columns(),
        values: matrix.values(),
        errors: matrix.errors(),
    };
    let mut outputs = Vec::new();
    for target in targets {
        match target {
            TableTarget::File(path, _) => {
                let written = output::matrix::write_file(path, &table)?;
                outputs.extend(written.iter().map(|file| file.path.display().to_string()));
            }
            TableTarget::Stdout => {
                let mut out = std::io::BufWriter::new(std::io::stdout().lock());
                output::matrix::write(Format::Csv, &mut out, &table)?;
                std::io::Write::flush(&mut out)
                    .map_err(|e| Failure::Failed(format!("stdout: {e}")))?;
                outputs.push("stdout".into());
            }
        }
    }
    Ok(outputs)
}
