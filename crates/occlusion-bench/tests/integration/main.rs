//! The libraries against accel's brute force.

mod agree;
