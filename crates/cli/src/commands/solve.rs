//! `radiosity solve`: light a scene and write it out.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use output::Format;
use output::csv::{FreePlace, Place, Places};
use radiosity_core::{Mesh, Plan, Probe, Refined, StopReason};
use scene::{Scene, TriangleId};
use scene_import::Imported;

use crate::args::{AccelArg, PictureArgs};
use crate::failure::Failure;
use crate::live::Live;
use crate::memory::Budget;
#[cfg(feature = "html")]
use crate::page;
use crate::pipeline::{self, INTERRUPT, Solved};
use crate::prepared::{self, Prepared};
use crate::progress::Progress;
use crate::report::{Report, Run};
use crate::screen::{self, Event, count, key, percent, rough, say, seconds, tell};
use crate::settings::{self, Goal, Read, Solve, Target, Work};
use crate::snapshot::Snapshots;
use crate::{bundled, files};

/// Where the program without arguments writes.
const BUNDLED_OUTPUTS: &[&str] = &[
    "out/cornell.glb",
    #[cfg(feature = "png")]
    "out/cornell.png",
    "out/cornell.csv",
];
const BUNDLED_REPORT: &str = "out/cornell.json";

/// A form-factor defect above this share of the emitted power is worth a warning: the church,
/// the worst of the bundled scenes, has 3.3 % with the command of docs/gallery.md.
const DEFECT_WORTH_SAYING: f64 = 0.05;

/// More wrong-side light than this share of the emitted power is worth a warning: the
/// sampling alone finds less in a scene that is rightly wound.
const WRONG_SIDE_WORTH_SAYING: f64 = 1e-3;

/// Solves the bundled scene into the folder `out`.
pub(crate) fn bundled() -> Result<(), Failure> {
    bundled::check()?;
    std::fs::create_dir_all("out").map_err(|e| Failure::Failed(format!("out: {e}")))?;
    run(&Solve {
        scene: None,
        outputs: BUNDLED_OUTPUTS.iter().map(|path| Target::File(path.into())).collect(),
        report: Some(BUNDLED_REPORT.into()),
        probe: None,
        snapshot: None,
        live: None,
        keeping: settings::Keeping::default(),
        goal: Goal::Error(0.01),
        limits: settings::Limits::default(),
        work: Work { elements: None, accel: AccelArg::Auto, threads: None, everything: false },
        shooting: settings::Shooting::default(),
        read: Read {
            options: scene_import::Options::default(),
            exchange: radiosity_core::Exchange::OneSided,
        },
        picture: PictureArgs::default(),
    })
}

/// Reads, solves, writes, and says what happened.
pub(crate) fn run(settings: &Solve) -> Result<(), Failure> {
    let paths = settings.outputs.iter().filter_map(|t| match t {
        Target::File(path) | Target::Probes(path) => Some(path),
        #[cfg(feature = "html")]
        Target::Page(path) => Some(path),
        Target::Stdout => None,
    });
    let mut paths: Vec<&Path> = paths.chain(&settings.report).map(PathBuf::as_path).collect();
    if let Some(resume) = &settings.keeping.resume {
        files::check_apart(Some(resume), &paths)?;
    }
    paths.extend(settings.keeping.checkpoint.as_deref());
    files::check_apart(settings.scene.as_deref(), &paths)?;
    if let Some(probe) = &settings.probe {
        files::check_apart(Some(probe), &paths)?;
    }
    for path in paths {
        files::check(path)?;
    }
    let read = [&settings.scene, &settings.probe, &settings.keeping.resume];
    read.into_iter().flatten().try_for_each(|path| files::check_read(path))?;
    let mut progress = Progress::new(settings.goal);
    progress.phase("reading");
    let clock = Instant::now();
    let mut read = settings.read;
    // A lit GLB is the scene's own document, where it has one.
    read.options.keep_document = settings.outputs.iter().any(Target::is_glb);
    let (file, mut imported) = open(settings.scene.as_deref(), &read)?;
    check_factors(&file, &imported, &settings.read)?;
    let read_seconds = clock.elapsed().as_secs_f64();
    tell(|| Event::scene(&file, &imported), &format!("{file}: {}", imported.summary));
    screen::diagnostics(&imported.diagnostics);
    let document = keep_document(&file, &mut imported)?;
    let options = settings::output_options(&settings.picture, &imported.scene)?;
    let options = output::Options { document, ..options };
    check_paired(&imported.scene, &settings.read)?;

    let places = match &settings.probe {
        Some(path) => places(path, &imported.scene)?,
        None => Places::Surface(Vec::new()),
    };
    if let Some(budget) = Budget::of(settings, &imported.scene) {
        budget.check()?;
    }
    let timed = settings.limits.time.is_some();
    let goal = (settings.goal, settings.shooting.correction, timed);
    // What a plan knows of surfaces does not hold in the open.
    let open = matches!(&places, Places::Free(free) if !free.is_empty());
    let work = Work { everything: settings.work.everything || open, ..settings.work };
    let prepared = prepared::prepare(
        &imported.scene,
        &work,
        &settings.read,
        goal,
        settings.shooting.sharing,
        |phase| progress.phase(phase),
    )?;
    screen::log(|| Event::plan(&prepared.plan));
    let probes = probes(&places);
    let snapshots = Snapshots::of(settings, &imported.scene, &options);
    let mut live = Live::start(settings, &file, &imported, &options)?;
    let heard = (&mut progress, live.as_mut());
    let solved = pipeline::solve(&imported.scene, &prepared, settings, &probes, snapshots, heard)?;
    if let Some(live) = &mut live {
        live.finish(&solved.refined.work, &solved.refined.solution);
    }
    progress.phase("writing");
    if settings.shooting.split == radiosity_core::Split::Centroid {
        screen::warning(
            "--split centroid: no edge is ever split, so meshes may agree on a wrong answer; the \
             stated error may be too small",
        );
    }
    warn_of_coarseness(&imported.scene, &solved.refined.mesh);
    say_solved(&prepared, &solved, settings);

    let clock = Instant::now();
    let report = |output_seconds: f64, outputs: &[String]| {
        Report::of(Run {
            file: &file,
            imported: &imported,
            settings,
            prepared: &prepared,
            solved: &solved,
            read_seconds,
            output_seconds,
            outputs: outputs.to_vec(),
        })
    };
    let mut outputs = Vec::new();
    for target in &settings.outputs {
        if *target == Target::Stdout {
            progress.clear();
        }
        let so_far = || report(clock.elapsed().as_secs_f64(), &outputs);
        let written = write(target, &imported, &solved, &places, &options, so_far)?;
        outputs.push(written);
    }
    let output_seconds = clock.elapsed().as_secs_f64();
    if let Some(path) = &settings.report {
        report(output_seconds, &outputs).write(path)?;
        outputs.push(path.display().to_string());
    }
    progress.clear();
    let times = format!(
        "time: read {}, plan {}, occluder {}, solve {}, output {}",
        seconds(read_seconds),
        seconds(prepared.plan_seconds),
        seconds(prepared.occluder_seconds),
        seconds(solved.seconds),
        seconds(output_seconds)
    );
    let event = || Event::Time {
        read_seconds,
        plan_seconds: prepared.plan_seconds,
        occluder_seconds: prepared.occluder_seconds,
        solve_seconds: solved.seconds,
        output_seconds,
    };
    tell(event, &times);
    tell(|| Event::Written { files: &outputs }, &format!("written: {}", outputs.join(", ")));
    Ok(())
}

/// Reads the places to report the light at.
fn places(path: &Path, scene: &Scene) -> Result<Places, Failure> {
    let file = File::open(path).map_err(|e| Failure::Failed(format!("{}: {e}", path.display())))?;
    let places = output::csv::read_places(file).map_err(|e| e.at(path))?;
    let triangles = scene.triangles().len();
    let Places::Surface(on_triangles) = &places else { return Ok(places) };
    // The header is the first line.
    match on_triangles.iter().zip(2..).find(|(place, _)| place.triangle as usize >= triangles) {
        None => Ok(places),
        Some((place, line)) => Err(Failure::Failed(format!(
            "{}:{line}: triangle {}, expected one of the scene's {triangles}, counted from 0",
            path.display(),
            place.triangle
        ))),
    }
}

fn probes(places: &Places) -> Vec<Probe> {
    let on = |&Place { triangle, uv, area }: &Place| Probe::Surface {
        triangle: TriangleId(triangle),
        uv,
        area,
    };
    let free = |place: &FreePlace| Probe::Free {
        position: place.position.into(),
        normal: place.normal.into(),
    };
    match places {
        Places::Surface(all) => all.iter().map(on).collect(),
        Places::Free(all) => all.iter().map(free).collect(),
    }
}

/// Segments keep off surfaces by a length that grows with the whole scene: one triangle far
/// away can make it larger than the rest of the scene.
pub(crate) fn warn_of_coarseness(scene: &Scene, mesh: &Mesh) {
    // A twentieth of a typical triangle: its shadows and contacts begin to go wrong.
    const WORTH_SAYING: f64 = 0.05;
    let mut areas: Vec<f64> = scene.ids().map(|id| scene.area(id)).filter(|a| *a > 0.0).collect();
    areas.sort_by(f64::total_cmp);
    let Some(median) = areas.get(areas.len() / 2) else { return };
    let resolution = mesh.resolution();
    if resolution > WORTH_SAYING * median.sqrt() {
        screen::warning(&format!(
            "the scene is {:.1e} across and its triangles are {:.1e}: what is nearer to a surface \
             than {resolution:.1e} is not seen from it, so the light will be wrong; take out \
             what lies far away",
            mesh.extent(),
            median.sqrt()
        ));
    }
}

/// Opens a file, or the bundled scene.
pub(crate) fn open(path: Option<&Path>, read: &Read) -> Result<(String, Imported), Failure> {
    path.map(files::check_read).transpose()?;
    match path {
        Some(path) => Ok((path.display().to_string(), scene_import::open(path, &read.options)?)),
        None => Ok((bundled::NAME.to_owned(), bundled::open(&read.options)?)),
    }
}

/// The scene's glTF document, if light can be put into it: better known now than at the end.
#[cfg(feature = "gltf")]
fn keep_document(
    file: &str,
    imported: &mut Imported,
) -> Result<Option<Arc<scene::Document>>, Failure> {
    let Some(document) = imported.document.take() else { return Ok(None) };
    output::check_document(&document).map_err(|error| error.at(file))?;
    Ok(Some(Arc::new(document)))
}

/// Nothing, as this build neither reads glTF nor writes it.
#[cfg(not(feature = "gltf"))]
fn keep_document(_: &str, _: &mut Imported) -> Result<Option<Arc<scene::Document>>, Failure> {
    Ok(None)
}

/// Refuses factors that only .tri files know, for any other scene.
pub(crate) fn check_factors(name: &str, imported: &Imported, read: &Read) -> Result<(), Failure> {
    let format = imported.summary.format;
    let plain = scene_import::Options::default();
    let [given, plain] = [read.options, plain].map(|o| (o.tri_light, o.tri_reflect));
    if format == scene_import::Format::Tri || given == plain {
        return Ok(());
    }
    let message = format!("--light, --reflect: are for .tri files, and {name} is {format}");
    Err(Failure::Usage(message))
}

/// The paired rule re-emits on both sides: above one half, light would grow for ever.
pub(crate) fn check_paired(scene: &Scene, read: &Read) -> Result<(), Failure> {
    const MOST: f64 = 0.5;
    if read.exchange != radiosity_core::Exchange::Paired {
        return Ok(());
    }
    match scene.materials().iter().find(|m| m.reflectance.max_channel() > MOST) {
        None => Ok(()),
        Some(m) => Err(Failure::Failed(format!(
            "--sides paired: material {:?} has reflectance {}, expected at most {MOST}: paired \
             surfaces re-emit what they reflect on both sides",
            m.name,
            m.reflectance.max_channel()
        ))),
    }
}

#[cfg_attr(not(feature = "html"), expect(unused_variables, reason = "only pages hold the report"))]
fn write(
    target: &Target,
    imported: &Imported,
    solved: &Solved,
    places: &Places,
    options: &output::Options,
    report: impl FnOnce() -> Report,
) -> Result<String, Failure> {
    let (scene, solution) = (&imported.scene, &solved.refined.solution);
    match target {
        Target::File(path) => {
            output::write_file(path, scene, solution, options)?;
            Ok(path.display().to_string())
        }
        Target::Probes(path) => {
            let Refined { probes, probe_irradiance, .. } = &solved.refined;
            output::replace_file(path, |out| {
                output::csv::write_probes(out, places, probes, probe_irradiance)
            })?;
            Ok(path.display().to_string())
        }
        #[cfg(feature = "html")]
        Target::Page(path) => {
            page::write_solved(path, imported, solution, options, &report())?;
            Ok(path.display().to_string())
        }
        Target::Stdout => {
            let mut out = std::io::BufWriter::new(std::io::stdout().lock());
            output::write(Format::Csv, &mut out, scene, solution, options)?;
            std::io::Write::flush(&mut out).map_err(|e| Failure::Failed(format!("stdout: {e}")))?;
            Ok("stdout".into())
        }
    }
}

/// Says what was left out, and what was foreseen beside what was done.
fn say_plan(plan: &Plan, refined: &Refined) {
    let left_out = plan.decisions.iter().filter(|decision| decision.leaves_out);
    let topics: Vec<&str> = left_out.map(|decision| decision.topic.name()).collect();
    let topics = if topics.is_empty() { "nothing left out".into() } else { topics.join(", ") };
    let (planned, done) = (&plan.planned, &refined.total_work);
    say(&format!(
        "plan: {topics}; foreseen {} form factors and {} segments, done {} and {}",
        rough(planned.form_factors),
        rough(planned.segments),
        rough(done.form_factors as f64),
        rough(done.rays as f64)
    ));
}

/// Says what ended the work before its goal, and how far it got.
fn say_limit(solved: &Solved, goal: Goal) {
    let Some(limit) = solved.limit else { return };
    let refined = &solved.refined;
    let what = match limit {
        INTERRUPT => "interrupted".into(),
        flag => format!("{flag} ended the work"),
    };
    let unshot = percent(refined.work.unshot);
    let elements = count(refined.mesh.elements().len() as u64);
    let stated = refined.statement.is_some_and(|s| s.triangles.e1.total().is_finite());
    let text = match goal {
        _ if refined.work.shots == 0 => {
            format!("{what} before the first step was done: what is written is the emittance alone")
        }
        Goal::Error(_) if stated => {
            format!("{what}: the error asked for is not reached, the one stated is")
        }
        Goal::Error(_) => format!(
            "{what}: the error asked for is not reached, and none is known yet; {unshot} of the \
             emitted power is unshot"
        ),
        Goal::Mesh { .. } => {
            format!("{what} with {elements} elements and {unshot} of the emitted power unshot")
        }
    };
    screen::limit(limit, &text);
}

fn say_solved(prepared: &Prepared, solved: &Solved, settings: &Solve) {
    let refined = &solved.refined;
    let (mesh, work, ledger) = (&refined.mesh, &refined.total_work, &refined.ledger);
    let (occluders, threads) = (prepared.occluder_name, prepared.threads());
    let line = format!(
        "{} elements in {} patches, {} receiver points; occluders: {}; {} {}",
        count(mesh.elements().len() as u64),
        count(mesh.patches().len() as u64),
        count(mesh.points().len() as u64),
        occluders,
        threads,
        if threads == 1 { "thread" } else { "threads" },
    );
    tell(|| Event::mesh(refined, occluders, threads), &line);
    if mesh.covered() > 0 {
        screen::warning(&format!(
            "{} triangles lie wholly or in part under earlier ones in their plane: what is \
             covered takes no part",
            count(mesh.covered() as u64)
        ));
    }
    if refined.reason == StopReason::NoLight {
        screen::warning("nothing emits: the scene stays dark");
        return;
    }
    let line = format!(
        "{} shots, {} segments, {} form factors; {} of the emitted power unshot{}",
        count(work.shots),
        count(work.rays),
        count(work.form_factors),
        key(&percent(work.unshot)),
        if refined.corrected { "; ambient corrections" } else { "" }
    );
    tell(|| Event::work(refined), &line);
    say_plan(&prepared.plan, refined);
    screen::statement(refined.statement.as_ref(), refined.reached);
    say_limit(solved, settings.goal);
    if let Some([least, most]) = refined.closed_rows {
        let line = format!("rows: form factors summed to {least:.6} to {most:.6}, closed to 1");
        tell(|| Event::Rows { least, most }, &line);
    }
    let line = format!(
        "energy: absorbed {}, escaped {} (form factors: {}), wrong side {}, unshot {}; sum off by {:.0e}",
        percent(ledger.share(ledger.absorbed)),
        percent(ledger.share(ledger.escaped)),
        percent(ledger.share(ledger.form_factor_defect)),
        percent(ledger.share(ledger.wrong_side)),
        percent(ledger.share(ledger.unshot)),
        ledger.imbalance()
    );
    tell(|| Event::energy(ledger), &line);
    let defect = ledger.share(ledger.form_factor_defect);
    if defect.abs() > DEFECT_WORTH_SAYING {
        screen::warning(&format!(
            "form factors: {} of the power was {}; {}",
            percent(defect.abs()),
            if defect < 0.0 { "received and never shot" } else { "shot and never received" },
            if defect < 0.0 {
                "surfaces that face the same way may lie in one another, or elements are too large"
            } else {
                "elements may be too large for what lies between them"
            }
        ));
    }
    let wrong_side = ledger.share(ledger.wrong_side);
    if wrong_side > WRONG_SIDE_WORTH_SAYING {
        screen::warning(&format!(
            "wrong side: {} of the power meets the backs of one-sided surfaces and is absorbed \
             there; --sides both lights both sides",
            percent(wrong_side)
        ));
    }
}
