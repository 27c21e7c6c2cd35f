//! What a baseball bat does when it meets a ball.
//!
//! A bat's profile becomes a beam, the beam's bending modes follow from its stiffness and mass, and
//! a collision model says how fast the ball leaves, how much energy stays in the vibration, where
//! the sweet spot is and why. You ask for an accuracy, not for elements, and every frequency, node,
//! modal mass and exit speed comes with an estimate of its own error.
//!
//! ```text
//! bat.json ─▶ Bat ─▶ Plan ─▶ elements ─▶ Statics (K, M) ─▶ modes ─▶ hit
//!                     └─ refined until the modes' errors are small enough
//! ```
//!
//! `crates/report` makes tables, pages and JSON of them. Each arrow is one function that borrows what lies to its left and returns a new value.
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
//! // Five bending modes, every frequency within 1e-8 of the exact beam's; whether shear counts is found out.
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
//! A bat that meets the ball near the nodes of its first modes rings least there, and the barrel's
//! speed grows towards the tip while the mass it has behind the ball falls: the fastest ball is
//! where the three balance. `examples/` answers longer questions, `docs/theory.md` has the equations
//! in one piece, and the `sweetspot` program does all of this from a bat file.
//!
//! # The chapters, in the order of the flow
//!
//! A chapter uses only those above it, and a file in it only the files declared above it, so that
//! `src/` can be read from top to bottom.
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
//! What this documentation passes over, [`eigen`] and [`beam`] among it, is how the library works inside: open to the
//! tests and to the crates beside this one (`crates/`: studies, proofs, reports, the program), and no part of what a
//! version promises.
//!
//! # What is promised
//!
//! True errors of frequencies, nodes, modal masses and exit speeds are within three times the stated ones,
//! always; the stated are within thirty times the true in nine cases of ten, and `sweetspot validate --promise` checks
//! both. Where an accuracy cannot be reached the best answer comes with the reason in [`Solution::ending`].
//!
//! # Conventions
//!
//! - SI everywhere inside. Units stand at the border only: a file's bare number is SI, a string
//!   carries its unit, and what is written out names it (`frequency_hz`).
//! - `x` runs from the knob end to the tip. Angles are positive where the tip goes ahead.
//! - Modes are scaled to a largest |φ| of 1, the barrel end positive ([`Mode`]); `modal_mass` goes
//!   with that scale. The batch's and the solver's inner vectors say their own.
//! - Orders count from 1, bending modes only; how many motions are rigid is told beside them.
//! - A swing goes in +: the bat moves in +, the ball comes in − and leaves in +. Speeds of balls
//!   that are asked for are positive towards the bat. A pivot beyond the knob is positive.
//! - Inertias are the body's, sections' own `∫ρI dx` included; a theory without rotary inertia
//!   recoils as a line of mass, and says so (`sweetspot_study::ignored`).
//! - What does not exist is `None`, and null in a file; no NaN and no infinity is given out.
//!
//! # Symbols
//!
//! A module that uses a letter otherwise says so at the formula.
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
//! | `ζ`, `s = −ζω + iω_d` | damping ratio; how a damped motion goes, as `e^{st}` | 1, 1/s |
//! | `ε` | 2⁻⁵², the spacing of numbers at 1 (in [`collision::aftermath`] a strain) | 1 |
//!
//! | the hit | meaning | unit |
//! |---|---|---|
//! | `a`, `J` | impact point, impulse | m, N s |
//! | `V`, `v`, `u` | speed of the bat at `a`, of the ball, closing speed `V − v` | m/s |
//! | `Ω` | angular speed of the swing | rad/s |
//! | `M_eff`, `μ` | what the stiff bat weighs at `a`; with the ball, `1/μ = 1/m + 1/M_eff` | kg |
//! | `F = k x^α`, `β` | the ball's force at its compression x, its exponent on the way back | N, m |
//! | `c_n = φ_n(a)²/m_n` | how readily mode n gives way at `a` | 1/kg |
//! | `C` | flexibility of the modes left out | m/N |
//! | `e`, `e₀`, `e_A` | coefficient of restitution, the ball's on a rigid wall, collision efficiency | 1 |
//! | `τ`, `κ` in [`collision::pulse`] | duration of a pulse, share of the vibration that the ball need not lose | s, 1 |
//!
//! # What is left out
//!
//! Sections of the beam stay round and plane: hoop modes of hollow barrels are counted in hits
//! ([`collision::hoop_wall`]) and no beam's, and wood that differs across the grain is not modelled. What a
//! theory leaves out on a bat is estimated and reported with every solution (`sweetspot_study::ignored`), and
//! `sweetspot_study::advise` measures what each part of a model does. A hit counts dashpots mode by mode
//! ([`collision`]). The ball meets the bat head on, without spin and friction.
//!
//! # Features
//!
//! `parallel`: work on all processors. `schema`: JSON schemas of bat and ball files. `descriptors`: writing to an
//! open descriptor where it stands (Linux). `arpack`: the solver ARPACK as an outside referee; it needs a C compiler
//! and the library. With none of them there is the physics and the readers of bats, balls and scenes, which also run
//! in a browser (`wasm32-unknown-unknown`).

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
