//! What is the shape of the bat in a photograph?
//!
//! The bat lies on plain ground and is seen from above. Its length and its largest diameter are given.
//!
//! | file | question |
//! |---|---|
//! | `picture` | what is the colour of a place in the picture, and what would it be without a bat |
//! | `find` | where in the picture is the bat |
//! | `edges` | where exactly are its two edges and its ends |
//! | `camera` | what is the size of a pixel, from what distance was the picture taken |
//! | `shape` | what are the diameters of the bat, and their errors |
//! | `traced` | the question of the page: pictures in, a bat file out |

mod picture;
mod find;
mod edges;
mod camera;
mod shape;
mod traced;

pub use traced::answer;
