"""numpy, imported when an oracle first asks it for something: drawing, solving and judging never do."""

from typing import TYPE_CHECKING, Any, TypeAlias

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    #: Numbers in floating point.
    Array: TypeAlias = NDArray[np.float64]
else:
    Array = Any

    class _Later:
        def __getattr__(self, name: str) -> Any:
            import numpy

            return getattr(numpy, name)

    np = _Later()

__all__ = ["Array", "np"]
