//! How reliable are the answers of a hit?
//!
//! [`Verdict::of`] is computed once for a hit. Every screen about the hit uses the result, so that no screen is more
//! certain than another.

use crate::engine::{Bat, HoopInHit, Impact, LATER, Scene, Sweep, WallFigures, WhyRigid};
use crate::ignored::{SHEAR, ignored, thinnest_wall, wall_left_out};

/// A reason why the answers of a hit are less certain than their computation.
#[derive(Debug, Clone, PartialEq)]
pub enum Doubt {
    /// The density that follows from the mass is not that of the material.
    Density(String),
    /// Shear is left out because there is no shear modulus; the sentence says what it would change.
    Shear(String),
    /// The wall of the barrel is dented deeper than half of its thickness, where its theory ends; whether it is held.
    Dent(Box<WallFigures>, bool),
    /// The wall of a hollow barrel is taken as rigid, for the reason in the sentence.
    RigidWall(String),
    /// The fastest place lives on a later contact of bat and ball.
    LaterContact,
    /// The ball's law was not measured for such a hit.
    BallLaw,
    /// Exit speeds are less accurate than requested.
    ExitSpeeds {
        /// The largest error, over the closing speed.
        error: f64,
    },
}

impl Doubt {
    /// The subject of the doubt, in a word.
    pub fn about(&self) -> &'static str {
        match self {
            Self::Density(_) => "density",
            Self::Shear(_) => "shear",
            Self::Dent(..) => "dent",
            Self::RigidWall(_) => "rigid_wall",
            Self::LaterContact => "later_contact",
            Self::BallLaw => "ball_law",
            Self::ExitSpeeds { .. } => "exit_speeds",
        }
    }
}

/// How far the answers of a hit hold.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Verdict {
    /// The doubts; those about the bat first.
    pub doubts: Vec<Doubt>,
}

impl Verdict {
    /// The verdict on the hits of a bat; `best` is the fastest, with its dent in the wall.
    pub fn of(
        (bat, scene): (&Bat, &Scene),
        hits: &Sweep,
        best: Option<&Impact>,
        wall: Option<WallFigures>,
    ) -> Self {
        let density = bat.density_off().or_else(|| bat.stiffness_off()).map(Doubt::Density);
        let said = ignored(bat, &hits.solution).into_iter().filter(|_| !bat.knows_shear());
        let shear = said.filter_map(|text| Some(text.strip_prefix(SHEAR)?.to_owned())).next();
        let shear = shear.map(Doubt::Shear);
        let deep = wall.filter(WallFigures::is_deep);
        let dent = deep.map(|wall| Doubt::Dent(Box::new(wall), bat.fixtures().holding()));
        let rigid = rigid_wall(bat, scene).map(Doubt::RigidWall);
        let flagged =
            |flags: &[&str]| best.is_some_and(|best| best.flags.iter().any(|f| flags.contains(f)));
        let later = flagged(&LATER).then_some(Doubt::LaterContact);
        let law = flagged(&["ball_law_beyond"]).then_some(Doubt::BallLaw);
        let unmet = hits.worst().filter(|_| !hits.met());
        let unmet = unmet.map(|(_, outcome)| Doubt::ExitSpeeds { error: outcome.error });
        let doubts = [density, shear, dent, rigid, later, law, unmet];
        Self { doubts: doubts.into_iter().flatten().collect() }
    }

    /// Whether the known uncertainty of the bat is only a lower limit, because its material or its shape is not as
    /// assumed.
    pub fn bat_is_open(&self) -> bool {
        self.doubts.iter().any(|doubt| matches!(doubt, Doubt::Density(_)))
    }

    /// Whether it bends otherwise than computed, because shear is left out.
    pub fn bending_is_open(&self) -> bool {
        self.doubts.iter().any(|doubt| matches!(doubt, Doubt::Shear(_)))
    }

    /// Whether the known uncertainty of the ball's exit is only a lower limit: the wall is beyond its theory or left
    /// out, or the ball is beyond its law or is struck again.
    pub fn ball_is_open(&self) -> bool {
        let open = |doubt: &Doubt| {
            use Doubt::{BallLaw, Dent, LaterContact, RigidWall};
            matches!(doubt, Dent(..) | RigidWall(_) | LaterContact | BallLaw)
        };
        self.doubts.iter().any(open)
    }
}

/// The reason why the wall of a hollow barrel is rigid in a hit that it would change, in a sentence; `None` if it
/// deflects, or if it changes less than the tolerance.
pub fn rigid_wall(bat: &Bat, scene: &Scene) -> Option<String> {
    if let HoopInHit::LeftOut(WhyRigid::Small { .. }) = scene.hoop {
        return None;
    }
    thinnest_wall(bat).filter(|_| !scene.wall_gives_way())?;
    wall_left_out(bat, scene)
}
