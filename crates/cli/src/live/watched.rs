//! A solve that is watched: frames for who asks, and no more of them than the work can spare.

use std::cell::Cell;
use std::sync::Arc;
use std::time::{Duration, Instant};

use radiosity_core::StepReport;
use scene::{Camera, Scene, Solution};
use scene_import::Imported;
use serde_json::json;
use viewer::{Means, Shown};

use super::exchange::Exchange;
use super::server::Server;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::page;
use crate::screen;
use crate::settings::Solve;

/// Frames take at most this share of the time: after one, the work goes on for nine times as long.
const SHARE: u32 = 10;
/// A page that has asked within this time is open: it asks every second.
const LATELY: Duration = Duration::from_secs(3);
/// So long the end of the program waits for readers that have not yet taken the last frame.
const LAST_WAIT: Duration = Duration::from_secs(2);

/// A server, and what frames are made of.
pub(crate) struct Live<'a> {
    exchange: Arc<Exchange>,
    server: Option<Server>,
    scene: &'a Scene,
    unit: &'static str,
    exposure: output::Exposure,
    view: Option<Camera>,
    goal: f64,
    clock: Instant,
    /// No frame before this time.
    next: Instant,
    /// When the frame that is being made was wanted.
    wanted: Cell<Option<Instant>>,
    failed: bool,
}

impl<'a> Live<'a> {
    /// Serves the viewer if the settings ask for it, and says where.
    pub(crate) fn start(
        settings: &Solve,
        file: &str,
        imported: &'a Imported,
        options: &output::Options,
    ) -> Result<Option<Self>, Failure> {
        let Some(port) = settings.live else { return Ok(None) };
        let failed = |e: std::io::Error| Failure::Failed(format!("--live: 127.0.0.1:{port}: {e}"));
        let mut page = Vec::new();
        viewer::write_live(&mut page, file).map_err(failed)?;
        let exchange = Arc::new(Exchange::default());
        let server = Server::open(port, page, Arc::clone(&exchange)).map_err(failed)?;
        screen::say(&format!("live: {}", server.url()));
        let scene = &imported.scene;
        let now = Instant::now();
        Ok(Some(Self {
            exchange,
            server: Some(server),
            scene,
            unit: page::unit(&imported.summary.format.to_string()),
            exposure: options.exposure,
            view: page::view(scene, options.camera.as_ref()),
            goal: settings.goal.converge(),
            clock: now,
            next: now,
            wanted: Cell::new(None),
            failed: false,
        }))
    }

    /// Lets a reader end the work as Ctrl-C does.
    pub(crate) fn heed(&self, interrupt: &Interrupt) {
        self.exchange.heed(interrupt);
    }

    /// Whether a frame is to be made now.
    pub(crate) fn wants(&self) -> bool {
        let now = Instant::now();
        let wants = !self.failed && now >= self.next && self.exchange.asked();
        self.wanted.set(wants.then_some(now));
        wants
    }

    /// Makes a frame if one was wanted.
    pub(crate) fn show(&mut self, work: &StepReport, solution: &Solution) {
        let Some(since) = self.wanted.take() else { return };
        self.put(work, solution, false);
        // From when it was wanted: the solver, too, does something for it.
        self.next = Instant::now() + since.elapsed() * (SHARE - 1);
    }

    /// Shows the light at its end to those who watch.
    pub(crate) fn finish(&mut self, work: &StepReport, solution: &Solution) {
        if self.exchange.watched(LATELY) {
            self.put(work, solution, true);
        }
    }

    fn put(&mut self, work: &StepReport, solution: &Solution, done: bool) {
        let progress = json!({
            "frame": self.exchange.next_number(),
            "seconds": self.clock.elapsed().as_secs_f64(),
            "elements": solution.elements.len(),
            "shots": work.shots,
            "unshot": work.unshot,
            "goal": self.goal,
            "done": done,
        });
        let shown = Shown {
            scene: self.scene,
            solution,
            unit: self.unit,
            exposure: self.exposure.scale_for(self.scene, solution),
            view: self.view.as_ref(),
            means: Means::OfElements,
        };
        match viewer::frame(&shown, &progress) {
            Ok(frame) => self.exchange.put(frame, done),
            Err(error) => {
                // The work is worth more than its being watched.
                screen::warning(&format!("--live: {error}; no more light is shown"));
                self.failed = true;
            }
        }
    }
}

impl Drop for Live<'_> {
    /// Closes with the run, when readers have what they are given or time is up.
    fn drop(&mut self) {
        self.exchange.drain(LAST_WAIT);
        drop(self.server.take());
    }
}
