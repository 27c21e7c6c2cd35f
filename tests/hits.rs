//! Tests of hits and of hollow walls, as one program.

mod common;

mod aftermath;
mod ball_law;
mod collision;
mod contact;
mod hit_promise;
mod hoop;
mod hoop_hit;
mod later_contacts;
mod many_hits;
mod random_hits;
mod scenes;
