//! What shape has the bat on a photograph?
//!
//! The bat lies on plain ground and is seen from above. Its length and its largest diameter are told.
//!
//! | file | question |
//! |---|---|
//! | `picture` | what colour is a place of the picture, and what would it be without a bat |
//! | `find` | where on the picture does a bat lie |
//! | `edges` | where exactly are its two edges and its ends |
//! | `camera` | how long is a pixel, from how far was the picture taken |
//! | `shape` | which diameters has the bat, and how far may they be off |
//! | `traced` | the question of the page: pictures in, a bat file out |

mod picture;
mod find;
mod edges;
mod camera;
mod shape;
mod traced;

pub use traced::answer;
