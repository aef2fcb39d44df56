"""Jostle: dense crowds that push, with bodies and behaviours.

    import jostle

    scene = jostle.Scene("evacuation", seed=3, set={"groups.hall.count": 60})
    scene.run(20)                                # simulated seconds; other Python threads go on meanwhile
    x, y = scene["x"], scene["y"]                # arrays of how it is now
    print(scene.summary()["density_max"], scene.probes()["door"])

Units are SI throughout: metres, seconds, kilograms, newtons, radians; x east, y north, z up.
"""
from ._events import Events
from ._library import Error, data_folder
from ._words import Word
from .compare import Comparison, compare
from .live import LivePage, RecordingPage
from .picture import Picture
from .recording import Recording
from .scene import Agent, Body, Lift, Scene, Stair, Storey, Where
from .sweep import Sweep, sweep
from .table import Table

__all__ = ["Agent", "Body", "Comparison", "Error", "Events", "Lift", "LivePage", "Picture", "Recording", "RecordingPage", "Scene", "Stair",
           "Storey", "Sweep", "Table", "Where", "Word", "compare", "data_folder", "sweep", "version"]


def version() -> str:
    """The version of the C library, as "0.1.0"."""
    from ._library import lib, text_of

    return text_of(lib.jo_version())
