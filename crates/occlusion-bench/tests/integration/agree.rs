//! Every adapter gives the answers of brute force where no rounding can turn them.

use accel::{BruteForce, BruteForceConfig, NO_TRIANGLE, Occluder, Segment, Target};
use glam::DVec3;
use occlusion_bench::{
    Embree, EmbreeConfig, EmbreeLibrary, EmbreeScene, EmbreeWidth, Obvhs, ObvhsPreset, ObvhsShape,
    Triangle, Workload, soup, terrain,
};

/// How much triangles are grown or shrunk about their centroid, and segments about their middle,
/// to see whether an answer hangs on it: about a thousand times the rounding of f32.
const MARGIN: f64 = 1e-4;

/// Segments and the answers of brute force that stay the same within the margin.
struct Case {
    occluders: Vec<Triangle>,
    batches: Vec<(DVec3, Vec<Target>, Vec<bool>)>,
}

impl Case {
    fn new(occluders: Vec<Triangle>, count: usize) -> Self {
        let workload = Workload::new(occluders.clone(), &occluders, count);
        let brute = [1.0, 1.0 + MARGIN, 1.0 - MARGIN].map(|factor| {
            let scaled: Vec<Triangle> = occluders.iter().map(|t| scale(t, factor)).collect();
            BruteForce::build(&scaled, &BruteForceConfig::default())
        });
        let sure = |from: DVec3, to: DVec3| {
            let by = MARGIN * (to - from);
            let answer = brute[0].occluded(&Segment::new(from, to));
            let turned = brute.iter().any(|brute| {
                brute.occluded(&Segment::new(from - by, to + by)) != answer
                    || brute.occluded(&Segment::new(from + by, to - by)) != answer
            });
            (!turned).then_some(answer)
        };
        let random = workload.random.iter().map(|s| (s.from, vec![s.to]));
        let shooting = workload.shooting.iter();
        let shooting = shooting.map(|b| (b.from, b.targets.iter().map(|t| t.point).collect()));
        let mut batches = Vec::new();
        for (from, points) in random.chain(shooting) {
            let points: Vec<DVec3> = points;
            let (targets, answers): (Vec<_>, Vec<_>) = points
                .into_iter()
                .filter_map(|to| Some((Target { point: to, ignore: NO_TRIANGLE }, sure(from, to)?)))
                .unzip();
            batches.push((from, targets, answers));
        }
        let case = Self { occluders, batches };
        let answers: Vec<bool> = case.batches.iter().flat_map(|b| b.2.clone()).collect();
        let blocked = answers.iter().filter(|answer| **answer).count();
        // The case can tell a structure that never or always says yes.
        assert!(answers.len() > count && blocked > count / 10, "{blocked} of {}", answers.len());
        assert!(answers.len() - blocked > count / 10, "{blocked} of {}", answers.len());
        case
    }

    fn check(&self, name: &str, occluder: &dyn Occluder) {
        for (from, targets, answers) in &self.batches {
            let mut blocked = vec![false; targets.len()];
            occluder.occluded_batch(*from, NO_TRIANGLE, targets, &mut blocked);
            assert_eq!(&blocked, answers, "{name}: batch from {from}");
            for (target, answer) in targets.iter().zip(answers) {
                let segment = Segment::new(*from, target.point);
                assert_eq!(occluder.occluded(&segment), *answer, "{name}: {segment:?}");
            }
        }
        let nowhere = DVec3::splat(0.5);
        assert!(!occluder.occluded(&Segment::new(nowhere, nowhere)), "{name}: no length");
        assert!(!occluder.occluded(&Segment::new(nowhere, DVec3::NAN)), "{name}: not finite");
    }
}

fn scale(t: &Triangle, factor: f64) -> Triangle {
    let centroid = (t[0] + t[1] + t[2]) / 3.0;
    t.map(|corner| centroid + factor * (corner - centroid))
}

/// Far from the origin, so that an adapter that does not recentre fails.
fn cases() -> [Case; 2] {
    let far = |scene: Vec<Triangle>| -> Vec<Triangle> {
        scene.iter().map(|t| t.map(|corner| corner + DVec3::splat(1000.0))).collect()
    };
    [Case::new(far(soup(300)), 2000), Case::new(far(terrain(800)), 4000)]
}

#[test]
fn obvhs_agrees() {
    for case in cases() {
        for shape in [ObvhsShape::CwBvh, ObvhsShape::Bvh2] {
            for preset in [ObvhsPreset::Medium, ObvhsPreset::VerySlow] {
                let obvhs = Obvhs::build(&case.occluders, shape, preset);
                case.check(&format!("{shape:?} {preset:?}"), &obvhs);
                assert!(obvhs.bytes() > 0);
            }
        }
    }
}

#[test]
fn embree_agrees() {
    let library = match EmbreeLibrary::load() {
        Ok(library) => library,
        Err(error) => {
            println!("skipped: {error}");
            return;
        }
    };
    use EmbreeWidth::{Eight, Four, One, Sixteen};
    for case in cases() {
        for (robust, split) in [(true, false), (false, false), (true, true)] {
            let config = EmbreeConfig { robust, split };
            let scene = EmbreeScene::build(library.clone(), &case.occluders, &config).unwrap();
            assert!(scene.bytes() > case.occluders.len() * 48, "{} bytes", scene.bytes());
            for width in [One, Four, Eight, Sixteen] {
                for coherent in [false, true] {
                    let embree = Embree::new(scene.clone(), width, coherent);
                    case.check(&format!("{config:?} {width:?} {coherent}"), &embree);
                    check_stream(&case, &embree);
                }
            }
        }
    }
}

fn check_stream(case: &Case, embree: &Embree) {
    let segments: Vec<Segment> = case
        .batches
        .iter()
        .flat_map(|(from, targets, _)| targets.iter().map(|t| Segment::new(*from, t.point)))
        .collect();
    let answers: Vec<bool> = case.batches.iter().flat_map(|batch| batch.2.clone()).collect();
    let mut blocked = vec![false; segments.len()];
    embree.occluded_stream(&segments, &mut blocked);
    assert_eq!(blocked, answers);
}

#[test]
fn nothing_blocks_in_an_empty_scene() {
    let segment = Segment::new(DVec3::ZERO, DVec3::ONE);
    if let Ok(library) = EmbreeLibrary::load() {
        let scene = EmbreeScene::build(library, &[], &EmbreeConfig::default()).unwrap();
        assert!(!Embree::new(scene, EmbreeWidth::Four, false).occluded(&segment));
    }
    let far = [DVec3::splat(5.0), DVec3::new(6.0, 5.0, 5.0), DVec3::new(5.0, 6.0, 5.0)];
    let obvhs = Obvhs::build(&[far], ObvhsShape::CwBvh, ObvhsPreset::Medium);
    assert!(!obvhs.occluded(&segment));
}
