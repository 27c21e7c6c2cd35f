"""What happens when a baseball bat hits a ball.

>>> import sweetspot as ss
>>> bat = ss.Bat.from_file("r161")
>>> bat.modes(3).frequency_hz.round()
array([ 175.,  581., 1187.])

Numbers are in SI; texts contain their unit: ``bat.hit(bat_speed="72 mph")``.
"""

from ._bat import Bat, built_in_bats
from ._errors import SweetspotError, SweetspotTypeError
from ._results import Hit, Modes, Taps
from ._study import Study, StudyResult, run_study

__all__ = [
    "Bat",
    "Hit",
    "Modes",
    "Study",
    "StudyResult",
    "SweetspotError",
    "SweetspotTypeError",
    "Taps",
    "built_in_bats",
    "run_study",
]
__version__ = "0.1.0"
