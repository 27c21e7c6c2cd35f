//! How fast do a bat's modes decay, through its materials, hands and absorbers?
//!
//! [`crate::Solution::damping`] holds the result; [`damping`](fn@damping) computes it for other modes.
//!
//! A material with the loss factor η dissipates `2π η` times its strain energy in every cycle. A mode therefore has `ζ
//! = ½ Σ η_i U_i/U`, with `U_i` its strain energy in material i, bending and shear; springs and joints have no loss.
//! Dashpots couple the modes: the modes of the damped bat are complex, `e^{st}` with `s = −ζω ± iω√(1 − ζ²)`, `ω =
//! |s|`.
//!
//! In the time domain a material's loss counts as viscous, with that ζ at the mode's own frequency. In a frequency
//! response ([`crate::motion::frf`]) the stiffness is multiplied by `1 + iη` at every frequency.
//!
//! # Source
//!
//! E. E. Ungar, E. M. Kerwin, J. Acoust. Soc. Am. 34 (1962) 954, for loss factors by strain energy.

use std::fmt;

use serde::Serialize;

use crate::base::Result;
use crate::bat::Bat;
use crate::beam::{DEGREES, Elements};
use crate::modes::mode::Mode;
use crate::modes::pole::Group;
use crate::modes::reduced::Reduced;

/// How one mode decays.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Damped {
    /// Natural angular frequency `|s|` (rad/s); for two real s, `√(s₁ s₂)`.
    pub natural: f64,
    /// Damping ratio ζ = `−Re s/|s|`; 1 or more if the mode does not oscillate.
    pub ratio: f64,
    /// The part of ζ due to the materials.
    pub of_materials: f64,
    /// `−Re s` (1/s): the amplitude is proportional to `e^{−decay t}`; for two real s, the slower one.
    pub decay: f64,
    /// Possible error of s relative to |s|, due to the mesh, to the small number of strains, and to treating modes one
    /// by one if that was done.
    pub error: f64,
}

impl Damped {
    /// A mode without damping, or with a damping ratio below 1.
    fn new(natural: f64, ratio: f64, of_materials: f64) -> Self {
        let decay = match ratio > 1.0 {
            true => natural / (ratio + ((ratio - 1.0) * (ratio + 1.0)).sqrt()),
            false => ratio * natural,
        };
        Self { natural, ratio, of_materials, decay, error: 0.0 }
    }

    /// `|Im s|` (rad/s): its angular frequency of oscillation; 0 if it does not oscillate.
    pub fn swinging(&self) -> f64 {
        self.natural * ((1.0 - self.ratio) * (1.0 + self.ratio)).max(0.0).sqrt()
    }

    /// Distance of another s from this one, relative to |s|; for two real ones, of the slower.
    fn apart(&self, other: &Self) -> f64 {
        let [a, b] = [self, other].map(|damped| [damped.decay, damped.swinging()]);
        (a[0] - b[0]).hypot(a[1] - b[1]) / self.natural
    }

    /// Q as the sharpness of a resonance, the frequency over the half-power bandwidth at light damping: `1/(2ζ)`.
    /// `None` without damping.
    ///
    /// # Source
    ///
    /// J. O. Smith, Introduction to Digital Filters (2007), appendix "Quality Factor (Q)": the
    /// resonance frequency over twice the decay rate.
    pub fn q_half_power(&self) -> Option<f64> {
        (self.ratio > 0.0).then(|| 0.5 / self.ratio)
    }

    /// Q of the amplitude, as papers on bats define it: `1/ζ`, so that the amplitude falls as `e^{−ωt/Q}`. Twice the
    /// usual Q. `None` without damping.
    ///
    /// # Source
    ///
    /// A. M. Nathan, Am. J. Phys. 68 (2000) 979, after L. L. Van Zandt, Am. J. Phys. 60 (1992) 172, who uses a value of
    /// 10.
    pub fn q_amplitude(&self) -> Option<f64> {
        (self.ratio > 0.0).then(|| 1.0 / self.ratio)
    }
}

/// How a bat's modes decay.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Damping {
    /// One for each mode of the solution; empty without any damping.
    pub modes: Vec<Damped>,
    /// ζ of each undamped mode treated alone.
    pub alone: Vec<f64>,
    /// Decay rates (1/s) of the rigid motions that only dashpots restrain.
    pub rigid: Vec<f64>,
    /// How the modes were found.
    pub kind: DampingMethod,
}

impl Damping {
    /// Each mode treated alone.
    fn by_modes(modes: Vec<Damped>, rigid: Vec<f64>, kind: DampingMethod) -> Self {
        let alone = modes.iter().map(|damped| damped.ratio).collect();
        Self { modes, alone, rigid, kind }
    }
}

/// Method by which the damping was computed.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
#[non_exhaustive]
pub enum DampingMethod {
    /// The bat has no damping.
    #[default]
    None,
    /// Only materials damp the bat: mode by mode.
    Materials,
    /// There are dashpots, but each mode may be treated alone: the complex modes differ by this much.
    Modal(f64),
    /// Complex modes; modes treated one by one would have this error.
    Complex(f64),
}

impl fmt::Display for DampingMethod {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::None => write!(f, "none"),
            Self::Materials => {
                write!(f, "of the materials alone, by each mode's strain energy in them")
            }
            Self::Modal(change) => write!(
                f,
                "mode by mode: complex modes would change a frequency by {change:.1e} of itself or \
                 a damping ratio by as much at most, which is within the tolerance"
            ),
            Self::Complex(change) => write!(
                f,
                "complex modes: dashpots couple the modes, which one by one would be off by up to \
                 {change:.1e} of the frequency"
            ),
        }
    }
}

/// The decay of the modes of a bat on those elements. Complex modes are computed if the dashpots change a frequency or
/// a damping ratio by more than `tolerance`.
///
/// ```
/// use sweetspot::modes::damping::damping;
/// use sweetspot::{Bat, Request, solve};
///
/// # fn main() -> sweetspot::Result<()> {
/// # let bat = Bat::builtin("r161")?;
/// let lossy = bat.with(|parts| parts.material.loss_factor = 0.01)?;
/// let solution = solve(&lossy, &Request::default())?;
/// let found = damping(&lossy, solution.elements(), &solution.modes, 1e-4)?;
/// assert!((found.modes[0].ratio - 0.5 * 0.01).abs() < 1e-12); // ζ = η/2
/// # Ok(())
/// # }
/// ```
///
/// # Errors
///
/// [`crate::Error::NotConverged`] if the modes, or those of the damped bat, cannot be found again.
pub fn damping(bat: &Bat, elements: Elements, modes: &[Mode], tolerance: f64) -> Result<Damping> {
    let dashpots = bat.fixtures().damping();
    let [own, sheared] = bat.material().losses();
    let mut materials = bat.layups().iter().flat_map(|layup| layup.materials());
    let alike = own == sheared && materials.all(|material| material.losses() == [own; 2]);
    if modes.is_empty() || (alike && own == 0.0 && !dashpots) {
        return Ok(Damping::default());
    }
    if alike && bat.fixtures().none_moving() && !dashpots {
        let damped = |mode: &Mode| Damped::new(mode.omega, 0.5 * own, 0.5 * own);
        let modes = modes.iter().map(damped).collect();
        return Ok(Damping::by_modes(modes, vec![], DampingMethod::Materials));
    }
    let mut reduced = Reduced::new(bat, elements, modes.len())?;
    let of_materials: Vec<f64> = (0..modes.len()).map(|k| 0.5 * reduced.mode_loss(k)).collect();
    let alone = |k: usize| {
        let ratio = of_materials[k] + 0.5 * modes[k].omega * reduced.mode_damping(k);
        Damped::new(modes[k].omega, ratio, of_materials[k])
    };
    let mut alone: Vec<Damped> = (0..modes.len()).map(alone).collect();
    if !dashpots {
        return Ok(Damping::by_modes(alone, vec![], DampingMethod::Materials));
    }
    let together = Together::new(&mut reduced, tolerance, &of_materials)?;
    let change = |(a, b): (&Damped, &Damped)| {
        (a.natural / b.natural - 1.0).abs().max((a.ratio - b.ratio).abs())
    };
    let changes: Vec<f64> = together.motions.iter().zip(&alone).map(change).collect();
    let largest = changes.iter().copied().fold(0.0, f64::max);
    for ((damped, mode), change) in alone.iter_mut().zip(modes).zip(&changes) {
        damped.error = mode.error.total() + change;
    }
    let within = alone.iter().all(|damped| damped.error <= tolerance) || largest == 0.0;
    if within || changes.len() < alone.len() {
        return Ok(Damping::by_modes(alone, together.rigid, DampingMethod::Modal(largest)));
    }
    let together = together.refined(bat, elements, tolerance, &of_materials)?;
    let (modes, rigid) = (together.motions, together.rigid);
    let alone = alone.iter().map(|damped| damped.ratio).collect();
    Ok(Damping { modes, alone, rigid, kind: DampingMethod::Complex(largest) })
}

/// Relative round-off of the small eigenproblem after its vectors are polished.
const ROUND_OFF: f64 = 32.0 * f64::EPSILON;
/// Most meshes on which the damped modes are recomputed.
const MOST_REFINEMENTS: usize = 4;

/// The complex modes of the damped bat on one mesh.
struct Together {
    motions: Vec<Damped>,
    rigid: Vec<f64>,
}

impl Together {
    /// Computes as many modes as there are entries in `of_materials`, the damping ratios due to materials.
    fn new(reduced: &mut Reduced, tolerance: f64, of_materials: &[f64]) -> Result<Self> {
        let free = reduced.free_motions(of_materials.len(), accuracy(tolerance))?;
        let motions = free.groups.iter().zip(of_materials);
        Ok(Self {
            motions: motions.map(|(group, ratio)| of_group(group, *ratio)).collect(),
            rigid: free.rigid.iter().map(|pole| -pole.s.re).collect(),
        })
    }

    /// Recomputes these modes on finer elements until the change is within the tolerance. Near a strong dashpot the bat
    /// moves as no undamped mode does, so the error of the undamped modes is not enough.
    fn refined(
        mut self,
        bat: &Bat,
        elements: Elements,
        tolerance: f64,
        of_materials: &[f64],
    ) -> Result<Self> {
        let Elements { mut degree, theory, .. } = elements;
        let mut mesh = elements.mesh.clone();
        for _ in 0..MOST_REFINEMENTS {
            (mesh, degree) = match degree + 2 <= *DEGREES.end() {
                true => (mesh, degree + 2),
                false => (mesh.refined(bat, |_| 2), degree),
            };
            let elements = Elements { mesh: &mesh, degree, theory };
            let mut finer = Reduced::new(bat, elements, of_materials.len())?;
            let before = self;
            self = Self::new(&mut finer, tolerance, of_materials)?;
            let errors = self.motions.iter_mut().zip(&before.motions);
            errors.for_each(|(now, before)| {
                now.error = now.error.max(now.apart(before)).max(ROUND_OFF);
            });
            if self.motions.iter().all(|damped| damped.error <= tolerance) {
                break;
            }
        }
        Ok(self)
    }
}

/// Accuracy of the damped modes for a tolerance: a high one costs little.
pub fn accuracy(tolerance: f64) -> f64 {
    (1e-3 * tolerance).clamp(1e-14, 1e-9)
}

fn of_group(group: &Group, of_materials: f64) -> Damped {
    let decays = group.poles.iter().map(|pole| -pole.s.re);
    Damped {
        natural: group.natural(),
        ratio: group.ratio(),
        of_materials,
        decay: decays.fold(f64::INFINITY, f64::min),
        error: group.poles.iter().map(|pole| pole.error).fold(0.0, f64::max),
    }
}
