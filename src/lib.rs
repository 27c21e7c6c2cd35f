//! What a baseball bat does when it meets a ball.
//!
//! A bat's profile becomes a beam. The beam's bending modes follow from its stiffness and mass. A collision model says
//! how fast the ball leaves, how much energy stays in the vibration, and where the sweet spot is and why. You ask for
//! an accuracy, not for a number of elements, and every frequency, node, modal mass and exit speed comes with an
//! estimate of its own error.
//!
//! ```text
//! bat.json ─▶ Bat ─▶ Plan ─▶ elements ─▶ Statics (K, M) ─▶ modes ─▶ hit
//!                     └─ refined until the modes' errors are small enough
//! ```
//!
//! Each arrow is one function that borrows what lies to its left and returns a new value. `crates/report` turns the
//! results into tables, pages and JSON.
//!
//! # A hit on a card
//!
//! ```
//! use sweetspot::{Bat, Hit, Swing};
//!
//! # fn main() -> sweetspot::Result<()> {
//! let bat = Bat::builtin("r161")?; // or Bat::from_file("mine.json")
//! let hit = Hit::of(&bat, &Swing::default())?;
//! println!("{:.2} m/s within {:.0e}, {:.3} m from the knob", hit.best.exit_speed, hit.best.error, hit.best.x);
//! for mode in hit.modes() {
//!     println!("{:.2} Hz", mode.frequency());
//! }
//! # assert!((hit.best.exit_speed / 48.21 - 1.0).abs() < 1e-3 && hit.reached == sweetspot::Reached::Asked);
//! # Ok(())
//! # }
//! ```
//!
//! # From calipers to a hit
//!
//! Diameters along the bat, a material and a kitchen scale make a [`Bat`]; no file is needed.
//!
//! ```
//! use sweetspot::collision::sweep::{Accuracy, sweep};
//! use sweetspot::collision::{Hitter, Model, Scene, SweetSpot};
//! use sweetspot::bat::profile::{Interpolation, Stations};
//! use sweetspot::{Bat, Material, Profile, Request, solve};
//!
//! # fn main() -> sweetspot::Result<()> {
//! let inches = [0.0, 0.5, 1.25, 3.0, 6.0, 12.0, 18.0, 24.0, 30.0, 33.5];
//! let diameters = [1.85, 1.95, 1.2, 0.98, 0.95, 1.05, 1.5, 2.3, 2.6, 2.45];
//! let x = inches.map(|x| 0.0254 * x).to_vec();
//! let outer = diameters.map(|d| 0.5 * 0.0254 * d).to_vec();
//! let (inner, interpolation) = (vec![0.0; x.len()], Interpolation::Pchip);
//! let profile = Profile::new(Stations { x, outer, inner, interpolation })?;
//! let maple = Material::named("sugar-maple-dynamic").expect("it is built in");
//! let bat = Bat::builder(profile, maple).name("my maple").mass(Some(0.893)).build()?; // weighed, in kg
//! println!("it balances {:.3} m from the knob", bat.inertia().balance_point);
//!
//! // Five bending modes, each frequency within 1e-8 of the exact beam's. The solver finds out whether shear matters.
//! let asked = Request { modes: 5, tolerance: 1e-8, ..Request::default() };
//! let solution = solve(&bat, &asked)?;
//! assert!(solution.met());
//! for mode in &solution.modes {
//!     println!("{:.4} Hz within {:.0e}", mode.frequency(), mode.error.total());
//! }
//!
//! // A swing meets a pitch; exit speeds within 1e-4 of the closing speed.
//! let scene = Scene { swing: 45.0, ball_speed: 38.0, ..Scene::default() };
//! let accuracy = Accuracy { exit_speed: 1e-4, ..Accuracy::default() };
//! let hits = sweep(&bat, Model::Contact, &scene, &accuracy, &[0.6, 0.7, 0.8])?;
//! for (x, outcome) in hits.impacts.iter().filter_map(|at| Some((at.x, at.outcome.as_ref()?))) {
//!     println!("a ball met {x} m from the knob leaves at {:.2} m/s", outcome.exit_speed);
//! }
//!
//! // The sweet spot, and why it is there.
//! let hitter = Hitter::new(Model::Contact, &scene, &bat, &hits.solution, hits.effort)?;
//! let spot = SweetSpot::find(&hitter);
//! let best = spot.exit_speed_max.expect("a swung barrel meets the ball");
//! let energy = hitter.strike(best.x).outcome.expect("it met it there").energy;
//! println!("fastest, {:.2} m/s, at {:.3} m; of {:.0} J", best.value, best.x, energy.initial);
//! println!("{:.1} J stay in vibration, {:.1} J in the bat", energy.vibration, energy.bat_rigid);
//! let nodes = [spot.node_mode_1, spot.node_mode_2].map(|node| node.expect("a free bat has some"));
//! println!("the nodes of modes 1 and 2 are at {:.3} and {:.3} m", nodes[0], nodes[1]);
//! # assert!(hits.met() && nodes[0] < nodes[1]);
//! # let inwards = hitter.strike(best.x - 0.1).outcome.expect("it is hit").energy;
//! # assert!(inwards.vibration > 3.0 * energy.vibration);
//! # assert!(energy.imbalance.abs() < 1e-9 * energy.initial);
//! # Ok(())
//! # }
//! ```
//!
//! A hit near the nodes of the first modes excites the least vibration. Towards the tip the barrel moves faster, but
//! the bat's effective mass is smaller. The exit speed is highest where these three effects balance. `examples/`
//! answers longer questions, `docs/theory.md` has all equations, and the `sweetspot` program does all of this from a
//! bat file.
//!
//! # The chapters, in the order of the flow
//!
//! A chapter uses only the chapters above it, and a file uses only the files declared above it in its chapter. `src/`
//! can therefore be read from top to bottom.
//!
//! | chapter | question it answers |
//! |---|---|
//! | [`base`] | what do we count with, and how do we fail |
//! | [`bat`] | what bat is this |
//! | [`eigen`] | what are the extreme eigenvalues of an operator or of two matrices |
//! | [`beam`] | what does one element store; what does a load do to the bat |
//! | [`modes`] | how does the bat ring, as accurately as asked |
//! | [`motion`] | how does it move after a blow, under a force, at a frequency |
//! | [`collision`] | what do ball and bat do when they meet; where is the sweet spot |
//! | [`files`] | how do people and programs write it down |
//!
//! These pages omit internal parts, such as [`eigen`] and [`beam`]. The tests and the crates in `crates/` (studies,
//! proofs, reports, the program) can use them, but no version promises to keep them.
//!
//! # What is promised
//!
//! The true error of a frequency, node, modal mass or exit speed is always at most three times the stated error. In
//! nine cases of ten the stated error is at most thirty times the true one. `sweetspot validate --promise` checks both.
//! If an accuracy cannot be reached, the best answer is returned with the reason in [`Solution::ending`].
//!
//! # Conventions
//!
//! - Quantities inside the library are in SI. A bare number in a file is SI, a string carries its unit, and a key that
//!   is written out names its unit (`frequency_hz`).
//! - `x` runs from the knob end to the tip. A rotation is positive where the tip moves ahead.
//! - Modes are scaled to a largest |φ| of 1, positive at the barrel end ([`Mode`]), and `modal_mass` belongs to that
//!   scale. The batch and the solver scale their internal vectors differently; their comments say how.
//! - Orders count bending modes only, from 1. The number of rigid modes is given beside them.
//! - The bat swings in the direction +. The ball comes in − and leaves in +. A ball speed that a user gives is positive
//!   towards the bat. A pivot beyond the knob is positive.
//! - Inertias are those of the body and include the sections' `∫ρI dx`. In a theory without rotary inertia the bat
//!   recoils as a line of mass, and the answer reports that (`sweetspot_study::ignored`).
//! - A missing value is `None`, and null in a file. No result is NaN or infinite.
//!
//! # Symbols
//!
//! A module that uses a letter with another meaning says so at the formula.
//!
//! | the bat as a beam | meaning | unit |
//! |---|---|---|
//! | `x`, `L`, `h` | position from the knob end; length of the bat, of an element | m |
//! | `r`, `r_i` | outer and inner radius | m |
//! | `ρ`, `E`, `G`, `κ` | density, Young's and shear modulus, shear coefficient | kg/m³, Pa, Pa, 1 |
//! | `A`, `I` | area and second moment of area of a section (in [`eigen`], A is an operator) | m², m⁴ |
//! | `w`, `θ` | deflection, rotation of the section (θ = dw/dx without shear) | m, rad |
//! | `w″`, `γ`, `M`, `Q` | curvature, shear strain `w′ − θ`, bending moment, shear force (elsewhere M is the mass or the mass matrix) | 1/m, 1, N m, N |
//! | `p`, `N` | degree of an element's deflection, its number of coefficients `p + 1` | 1 |
//! | `s`, `ξ` | place on an element or a piece, 0 to 1 and −1 to 1 | 1 |
//! | `P_j` | Legendre's polynomial of degree j in ξ | 1 |
//! | `c`, `g`, `q` | an element's curvatures, shear strains, both scaled by the strain energy | 1/m, 1, 1 |
//! | `U` | strain energy, and the unit of energy in which it is `½ qᵀq` | J |
//! | `K`, `M`; `D = LLᵀ`, `S` | assembled stiffness and mass; stiffness of the strains; their integration | |
//!
//! | modes | meaning | unit |
//! |---|---|---|
//! | `ω = 2πf`, `λ = ω²` | angular frequency, eigenvalue | rad/s, 1/s² |
//! | `θ = 1/λ` in [`eigen`] | eigenvalue of the compliance, Ritz value | s² |
//! | `σ` | shift of the eigenvalues for solvers that factor | 1/s² |
//! | `φ_n`, `m_n` | mode shape with largest deflection 1, its modal mass | 1, kg |
//! | `η` | twice the relative error of a frequency, its defect; in [`modes::damping`] the loss factor | 1 |
//! | `ζ`, `s = −ζω + iω_d` | damping ratio; exponent of a damped motion `e^{st}` | 1, 1/s |
//! | `ε` | 2⁻⁵², the spacing of numbers at 1 (in [`collision::aftermath`] a strain) | 1 |
//!
//! | the hit | meaning | unit |
//! |---|---|---|
//! | `a`, `J` | impact point, impulse | m, N s |
//! | `V`, `v`, `u` | speed of the bat at `a`, of the ball, closing speed `V − v` | m/s |
//! | `Ω` | angular speed of the swing | rad/s |
//! | `M_eff`, `μ` | effective mass of the rigid bat at `a`; reduced mass with the ball, `1/μ = 1/m + 1/M_eff` | kg |
//! | `F = k x^α`, `β` | the ball's force at its compression x, its exponent on the way back | N, m |
//! | `c_n = φ_n(a)²/m_n` | mobility of mode n at `a` | 1/kg |
//! | `C` | flexibility of the modes left out | m/N |
//! | `e`, `e₀`, `e_A` | coefficient of restitution, the ball's on a rigid wall, collision efficiency | 1 |
//! | `τ`, `κ` in [`collision::pulse`] | duration of a pulse, share of the vibration that the ball need not lose | s, 1 |
//!
//! # What is left out
//!
//! Sections of the beam stay round and plane. The hoop modes of a hollow barrel are not modes of the beam: hits count
//! them separately ([`collision::hoop_wall`]). Wood that differs across the grain is not modelled. Every solution
//! estimates and reports what its theory leaves out on this bat (`sweetspot_study::ignored`), and
//! `sweetspot_study::advise` measures what each part of a model does. A hit counts dashpots mode by mode
//! ([`collision`]). The ball meets the bat head on, without spin and friction.
//!
//! # Features
//!
//! `parallel`: work on all processors. `schema`: JSON schemas of bat and ball files. `descriptors`: writing to an
//! open descriptor at its current position (Linux). `arpack`: the solver ARPACK as an outside referee; it needs a C
//! compiler and the library. Without features the crate has the physics and the readers of bats, balls and scenes,
//! which also run in a browser (`wasm32-unknown-unknown`).

#![warn(missing_docs)]
// Only `eigen::arpack`, which calls C, may ask for an exception.
#![deny(unsafe_code)]
#![cfg_attr(not(feature = "arpack"), forbid(unsafe_code))]
// Matrices are written with the indices of their formulas.
#![allow(clippy::needless_range_loop)]

pub mod base;
pub mod bat;
#[doc(hidden)]
pub mod eigen;
#[doc(hidden)]
pub mod beam;
pub mod modes;
pub mod motion;
pub mod collision;
pub mod files;

pub use base::error::{Error, Result};
pub use bat::body::Bat;
pub use bat::material::Material;
pub use bat::profile::Profile;
pub use bat::theory::Theory;
pub use collision::swing::{Hit, Reached, Swing};
pub use modes::mode::Mode;
pub use modes::solve::{Request, Solution, Solver, solve};
