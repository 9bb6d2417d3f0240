"""What every reader of the kernel's source asks before it believes it: the lifter and both compilers.

A class is read by its fields or members alone, and a name by where it stands in the text.  Where Python lets a class
or a function mean something else than that, it is refused here, once for all readers.
"""

from models.subset.classes import Unfit, unfit_class
from models.subset.names import UnfitName, unfit_name

__all__ = ["Unfit", "UnfitName", "unfit_class", "unfit_name"]
