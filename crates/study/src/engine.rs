//! The names of the engine that the studies use.

pub use sweetspot::base::error::nearest;
pub use sweetspot::base::linear::inverse;
pub use sweetspot::base::number::shortest;
pub use sweetspot::base::units::{INCH, POUND_FORCE, factor};
pub use sweetspot::base::{
    Complaint, Error, FilePosition, Mistakes, Quantity, Result, Tell, dot, error, file, gauss,
    golden, inches, linear, marks, mistakes, nobody, ounces, shown_length, significant, threads,
    typed, units,
};
pub use sweetspot::bat::{
    Attachment, BUILT_IN, Bat, Bore, Change, Cork, Cup, DiameterChange, Edit, Fixtures, Inertia,
    Interpolation, Layup, Material, Piece, Profile, Radii, Region, SAME_PLACE, STANDARD_PIVOT,
    Scatter, Section, Stations, Theory, Weighed, Worth,
};
pub use sweetspot::beam::wall::elastic::{ASSUMED_POISSON_RATIO, poisson_ratio};
pub use sweetspot::beam::{DEGREES, Mesh};
pub use sweetspot::collision::answer::LATER;
pub use sweetspot::collision::ball::Ball;
pub use sweetspot::collision::bbcor::TEST_SPEED;
pub use sweetspot::collision::figures::{BarrelSpeed, SwingLaw};
pub use sweetspot::collision::hit::{Effort, Impact, Model, Scene, greater};
pub use sweetspot::collision::hitter::Hitter;
pub use sweetspot::collision::hoop_wall::{HoopInHit, HoopWall, WhyRigid, barrel_walls};
pub use sweetspot::collision::rigid::RigidBat;
pub use sweetspot::collision::setup::Setup;
pub use sweetspot::collision::strike::Glance;
pub use sweetspot::collision::sweep::{Accuracy, Sweep, Trial, sweep};
pub use sweetspot::collision::sweet_spot::{FEW, HitsAlong, Peak, SweetSpot};
pub use sweetspot::collision::wall_figures::{WallBbcor, WallFigures};
pub use sweetspot::files::document::Document;
pub use sweetspot::files::folder::{Folder, Outside};
pub use sweetspot::files::json_node::{Node, Object};
pub use sweetspot::files::schema::amount::Amount;
pub use sweetspot::files::sheet::{Sheet, SheetRow};
pub use sweetspot::files::{balls, part_file, scene_file};
pub use sweetspot::modes::batch::{Way, solutions};
pub use sweetspot::modes::damping::Damped;
pub use sweetspot::modes::hoop::{Hoop, HoopMode, HoopRequest, KnobSide, rings};
pub use sweetspot::modes::mode::Mode;
pub use sweetspot::modes::plan::Plan;
pub use sweetspot::modes::prepared::{Prepared, prepare};
pub use sweetspot::modes::shares::Shares;
pub use sweetspot::modes::shifts::typical_shear;
pub use sweetspot::modes::solution::Timing;
pub use sweetspot::modes::solve::{
    MOST_DENSE, Request, Solution, Solver, own_and_recomputed, solve,
};
pub use sweetspot::modes::task::Task;
pub use sweetspot::modes::tuned::tuned;
pub use sweetspot::motion::frf::{Frf, ResponseKind};
pub use sweetspot::motion::sound::ASSUMED_LOSS;
