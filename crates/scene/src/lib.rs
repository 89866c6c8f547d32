#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod camera;
mod document;
mod error;
mod ids;
mod material;
mod rgb;
mod scene;
mod solution;

pub use camera::Camera;
pub use document::{Document, Shape};
pub use error::{Error, ErrorKind};
pub use ids::{GroupId, MaterialId, TriangleId, VertexId};
pub use material::{Material, Sides};
pub use rgb::Rgb;
pub use scene::{MOST_COORDINATE, Scene, SceneBuilder, Triangle};
pub use solution::{Face, Solution, SolutionElement};
