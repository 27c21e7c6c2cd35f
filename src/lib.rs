//! What a baseball bat does when it meets a ball.
//!
//! A bat's profile becomes a beam, the beam's free bending modes follow from sparse mass and
//! stiffness, and a collision model says how fast the ball leaves, how much energy stays in the
//! vibration and where the sweet spot is. Every frequency comes with an estimate of its error.
//!
//! ```text
//! bat.json ─▶ Bat ─▶ Plan ─▶ elements ─▶ Statics (K, M) ─▶ modes ─▶ hit ─▶ report ─▶ JSON, table
//!                     └─ refined until the modes' errors are small enough
//! ```
//!
//! Each arrow borrows what lies to its left and returns a new value; a module uses only those
//! declared above it.
//!
//! ```
//! use sweetspot::collision::hit::{Effort, Model, Scene};
//! use sweetspot::collision::hitter::Hitter;
//! use sweetspot::{Bat, Request, solve};
//!
//! # fn main() -> sweetspot::Result<()> {
//! let bat = Bat::from_file("meshes/r161.json")?;
//! let solution = solve(&bat, &Request { modes: 10, tolerance: 1e-6, ..Request::default() })?;
//! for mode in &solution.modes[..3] {
//!     println!("{:7.1} Hz, relative error {:.0e}", mode.frequency(), mode.error.total());
//! }
//!
//! let scene = Scene { swing: 50.0, ball_speed: 40.0, ..Scene::default() };
//! let hitter = Hitter::new(Model::Contact, &scene, &bat, &solution, Effort::default())?;
//! let hit = hitter.strike(0.70).outcome.expect("the ball is hit");
//! println!("a ball met 0.70 m from the knob leaves at {:.1} m/s", hit.exit_speed);
//! println!("and {:.1} J of {:.0} stay in vibration", hit.energy.vibration(), hit.energy.initial);
//! # Ok(())
//! # }
//! ```
//!
//! # Symbols
//!
//! SI everywhere inside; units only at the border, in names and strings. A module that uses a
//! letter otherwise says so at the formula.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `x` | position along the axis from the knob end | m |
//! | `L`, `h` | length of the bat, of an element | m |
//! | `r`, `r_i` | outer and inner radius | m |
//! | `ρ`, `E`, `G`, `κ` | density, Young's and shear modulus, shear coefficient | kg/m³, Pa, Pa, 1 |
//! | `A`, `I` | area and second moment of area of a section (in [`eigen`], A is an operator) | m², m⁴ |
//! | `w`, `θ` | deflection, rotation of the section (θ = dw/dx) | m, rad |
//! | `p`, `N` | degree of an element's deflection, its number of coefficients `p + 1` | 1 |
//! | `w″`, `M` | curvature, bending moment (elsewhere M is the mass matrix) | 1/m, N m |
//! | `c`, `q` | strains of an element, the same scaled by the strain energy | 1/m, √J |
//! | `s`, `ξ` | place on an element or a piece, 0 to 1 and −1 to 1 | 1 |
//! | `P_j` | Legendre's polynomial of degree j in ξ | 1 |
//! | `ω = 2πf`, `λ = ω²` | angular frequency, eigenvalue | rad/s, 1/s² |
//! | `θ = 1/λ` in [`eigen`] | eigenvalue of the compliance, Ritz value | s² |
//! | `σ` | shift of the eigenvalues for solvers that factor | 1/s² |
//! | `η` | twice the relative error of a frequency, its defect; in [`damping`] the loss factor | 1 |
//! | `ζ` | damping ratio | 1 |
//! | `φ_n`, `m_n` | mode shape with largest deflection 1, its modal mass | 1, kg |
//! | `a`, `J` | impact point, impulse | m, N s |
//! | `e`, `e_A` | coefficient of restitution, collision efficiency | 1 |
//!
//! # What is left out
//!
//! Sections stay round and plane: hoop modes of hollow barrels, and wood that differs across the
//! grain, are no beam's. What a theory leaves out on a bat is estimated and reported with every
//! solution ([`ignored`]), and [`advise`] measures what each part of a model does. A barrel's wall
//! under the ball is one spring-mass of the caller's own figures, and a hit counts dashpots mode by
//! mode ([`collision`]).

// Only `eigen::arpack`, which calls C, may ask for an exception.
#![deny(unsafe_code)]
#![cfg_attr(not(feature = "arpack"), forbid(unsafe_code))]
// Matrices are written with the indices of their formulas.
#![allow(clippy::needless_range_loop)]

pub mod error;
mod mistakes;
pub mod units;
pub mod real;
pub mod lanes;
pub mod quadrature;
pub mod material;
pub mod theory;
mod pchip;
pub mod formula;
pub mod profile;
mod formula_profile;
pub mod layup;
pub mod fixtures;
mod fixtures_check;
pub mod bat;
mod document;
mod broken_json;
mod json_node;
mod csv_file;
mod station_table;
mod material_file;
mod fixtures_file;
mod bat_file;
pub mod shape_file;
pub mod force_file;
pub mod eigen;
pub mod beam;
pub mod eigenpairs;
pub mod modes;
pub mod flexible;
pub mod reduced;
pub mod damping;
pub mod certificate;
pub mod factored;
pub mod survey;
pub mod plan;
pub mod solve;
pub mod batch;
pub mod trade;
pub mod ignored;
pub mod choice;
pub mod weighed;
pub mod advise;
pub mod dowel;
pub mod response;
pub mod ringing;
pub mod frf;
pub mod collision;
pub mod report;
pub mod known_hits;
pub mod validation;
pub mod published;
pub mod hit_figure;
pub mod validation_page;
pub mod promise;
pub mod extremes;

pub use bat::Bat;
pub use error::{Error, Result};
pub use modes::Mode;
pub use solve::{Request, Solution, Solver, solve};
