//! Flags that say who shoots with whom, on which threads, and where elements are split.

use std::num::NonZeroUsize;

use clap::ValueEnum;
use radiosity_core::{Schedule, Split};
use radiosity_par::Loop;

#[derive(Clone, Debug, clap::Args)]
#[command(next_help_heading = "Schedules and splitting")]
pub(crate) struct ShootingArgs {
    /// Patches that shoot together: `auto` (those about as bright as the brightest), `single` or
    /// `multi:K`. The light converges to the same, by other steps
    #[arg(long, value_name = "S", default_value = "auto", value_parser = schedule)]
    pub(crate) schedule: Schedule,

    /// Shoot what there is, and not in advance what patches will still receive
    #[arg(long)]
    pub(crate) no_overshoot: bool,

    /// Show unshot light, too, as an even ambient light: pictures of a solve that is cut short or
    /// still on its way come closer to the end. Counts as unknown in the stated error
    #[arg(long)]
    pub(crate) ambient: bool,

    /// Leave uniform light to the shots where little is absorbed, without ambient corrections
    #[arg(long)]
    pub(crate) no_corrections: bool,

    /// How threads share the work of a step: `tasks` (stealing from each other), `static`,
    /// `dynamic:N` or `guided:N`. The result does not depend on it
    #[arg(long = "loop", value_name = "L", default_value_t = Loop::Tasks)]
    pub(crate) sharing: Loop,

    /// How --error splits elements where the light changes; `none`: all elements of one size
    #[arg(long, value_enum, default_value_t = SplitArg::LongestEdge)]
    pub(crate) split: SplitArg,

    /// Split no element of this area or less, in the scene's unit squared
    #[arg(long, value_name = "AREA", default_value_t = 0.0)]
    pub(crate) min_area: f64,

    /// Halve no triangle of the scene more than this many times over
    #[arg(long, value_name = "N")]
    pub(crate) max_depth: Option<u32>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum SplitArg {
    /// Halve longest edges, in all elements that share them
    LongestEdge,
    /// Cut elements into three at their centroids: for comparison, since angles shrink
    Centroid,
    /// Finer meshes have elements of one size
    None,
}

impl From<SplitArg> for Split {
    fn from(arg: SplitArg) -> Self {
        match arg {
            SplitArg::LongestEdge => Self::LongestEdge,
            SplitArg::Centroid => Self::Centroid,
            SplitArg::None => Self::None,
        }
    }
}

/// `auto`, `single` or `multi:K`.
fn schedule(text: &str) -> Result<Schedule, String> {
    let several = |text: &str| text.strip_prefix("multi:")?.parse::<NonZeroUsize>().ok();
    match text {
        "auto" => Ok(Schedule::Auto),
        "single" => Ok(Schedule::Single),
        _ => several(text).filter(|k| k.get() <= MOST_SHOOTERS).map(Schedule::Multi).ok_or_else(
            || format!("expected auto, single or multi:K with K from 1 to {MOST_SHOOTERS}"),
        ),
    }
}

/// Each shooter of a step has slots for all receivers.
const MOST_SHOOTERS: usize = 1024;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn schedules_by_name() {
        let multi = |k| Schedule::Multi(NonZeroUsize::new(k).unwrap());
        assert_eq!(schedule("auto"), Ok(Schedule::Auto));
        assert_eq!(schedule("single"), Ok(Schedule::Single));
        assert_eq!(schedule("multi:4"), Ok(multi(4)));
        for text in ["multi", "multi:", "multi:0", "multi:-1", "multi:1025", "Auto", ""] {
            assert!(schedule(text).is_err(), "{text}");
        }
    }
}
