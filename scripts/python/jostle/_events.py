"""Events of a step as structured arrays: the C structs as NumPy sees them."""
from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from ._library import ffi

TRANSITION = np.dtype([(name, np.uint32) for name in ("agent", "machine", "from", "to")])
TOUCH = np.dtype([(name, np.uint32) for name in ("agent", "kind", "other", "began")] + [("force", np.float32)])
HIT = np.dtype([("agent", np.uint32), ("body", np.uint32)] + [(name, np.float32) for name in ("impulse", "x", "y", "z")])
BREAK = np.dtype([(name, np.uint32) for name in ("body", "bonds", "pieces")])
PRESENCE = np.dtype([("agent", np.uint32), ("group", np.uint32), ("x", np.float32), ("y", np.float32)])
SAID = np.dtype([("agent", np.uint32), ("signal", np.uint32), ("x", np.float32), ("y", np.float32)])
ACTION = np.dtype([(name, np.uint32) for name in ("agent", "kind", "other")] + [("x", np.float32), ("y", np.float32)])

for _dtype, _struct in ((TRANSITION, "JoTransitionEvent"), (TOUCH, "JoTouchEvent"), (HIT, "JoHitEvent"),
                        (BREAK, "JoBreakEvent"), (PRESENCE, "JoPresenceEvent"), (SAID, "JoSaidEvent"),
                        (ACTION, "JoActionEvent")):
    assert _dtype.itemsize == ffi.sizeof(_struct), _struct


class Events(NamedTuple):
    """What happened in the last step, each an array with a record for each event, copied.

    transitions: agent, machine, from, to (numbers of states); touches: agent, kind (0 agent, 1 body, 2 wall), other,
    began (1: since events were read last), force (N); hits: agent, body, impulse (N s), x, y, z (m); breaks: body,
    bonds, pieces; entered, left: agent, group, x, y, since events were read last; said: agent, signal, x, y;
    actions: agent, kind (0 kicked or threw, 1 took hold), other (slot of the body, id of the agent), x, y.
    """

    transitions: np.ndarray
    touches: np.ndarray
    hits: np.ndarray
    breaks: np.ndarray
    entered: np.ndarray
    left: np.ndarray
    said: np.ndarray
    actions: np.ndarray


def array_of(pointer: Any, count: int, dtype: np.dtype) -> np.ndarray:
    """A copy of `count` structs."""
    if count == 0:
        return np.empty(0, dtype)
    return np.frombuffer(ffi.buffer(pointer, count * dtype.itemsize), dtype).copy()


def events_of(e: Any) -> Events:
    """The arrays of a JoEvents."""
    return Events(array_of(e.transitions, e.transition_count, TRANSITION), array_of(e.touches, e.touch_count, TOUCH),
                  array_of(e.hits, e.hit_count, HIT), array_of(e.breaks, e.break_count, BREAK),
                  array_of(e.entered, e.entered_count, PRESENCE), array_of(e.left, e.left_count, PRESENCE),
                  array_of(e.said, e.said_count, SAID), array_of(e.actions, e.action_count, ACTION))
