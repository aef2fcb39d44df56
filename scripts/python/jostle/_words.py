"""Words that a program adds to the language of behaviours."""
from __future__ import annotations

from typing import Any, Callable, NamedTuple, Optional, Sequence

import numpy as np

from ._library import ffi, lib, named

TYPES = {lib.JO_U8: np.uint8, lib.JO_U16: np.uint16, lib.JO_U32: np.uint32, lib.JO_I32: np.int32, lib.JO_U64: np.uint64,
         lib.JO_F32: np.float32, lib.JO_F64: np.float64}
KINDS = {"number": lib.JO_WORD_NUMBER, "condition": lib.JO_WORD_CONDITION, "action": lib.JO_WORD_ACTION}


def column_of(world: Any, name: str) -> np.ndarray:
    """A column of a world in place: valid until the world changes."""
    column = lib.jo_world_column(world, named(name))
    if not column.stride and not column.count:
        raise KeyError(name)
    dtype = TYPES[column.type]
    if not column.count:
        return np.empty(0, dtype)
    extent = (column.count - 1) * column.stride + np.dtype(dtype).itemsize
    memory = ffi.buffer(ffi.cast("char *", column.data), extent)
    array = np.ndarray(column.count, dtype, memory, strides=(column.stride,))
    array.flags.writeable = False
    return array


class Columns:
    """Columns of the agents of a batch, by name: `columns["x"]`."""

    def __init__(self, world: Any, agents: np.ndarray) -> None:
        self._world, self._agents = world, agents

    def __getitem__(self, name: str) -> np.ndarray:
        return column_of(self._world, name)[self._agents]


class Word(NamedTuple):
    """A word of a program. A number or condition: `function(columns)` returns a value for each agent of a batch, from
    columns such as columns["x"]; it is called within steps, by several threads in turn, and must depend on nothing that
    changes meanwhile. An action: `function(id, numbers)` is called at the end of a step, for each agent that acts, and may
    use the scene but not step it. `example` is an expression, or for an action a call, with the word in it."""

    name: str
    function: Callable[..., Any]
    meaning: str
    example: str
    kind: str = "number"
    unit: str = ""


class Words:
    """The words of one scene as the library takes them. `failure` is what a function raised first."""

    def __init__(self, words: Sequence[Word], acting: Callable[[bool], None]) -> None:
        self.failure: Optional[BaseException] = None
        self.count = len(words)
        self.array = ffi.new("JoWord[]", max(1, len(words)))
        self._kept: list = []
        for made, word in zip(self.array, words):
            if word.kind not in KINDS:
                raise ValueError(f"a word is a number, condition or action, not {word.kind!r}")
            made.name, made.unit, made.meaning, made.example = (self._text(text) for text in
                                                                (word.name, word.unit, word.meaning, word.example))
            made.kind = KINDS[word.kind]
            if word.kind == "action":
                made.act = self._action(word.function, acting)
            else:
                made.values = self._values(word.function)

    def _text(self, text: str) -> Any:
        self._kept.append(ffi.new("char[]", named(text)))
        return self._kept[-1]

    def _values(self, function: Callable[..., Any]) -> Any:
        def values(_context: Any, world: Any, agents: Any, count: int, out: Any) -> None:
            target = np.frombuffer(ffi.buffer(out, 8 * count), np.float64)
            try:
                indices = np.frombuffer(ffi.buffer(agents, 4 * count), np.uint32)
                target[:] = function(Columns(world, indices))
            except BaseException as error:  # pylint: disable=broad-except
                target[:] = 0.0
                self.failure = self.failure or error

        self._kept.append(ffi.callback("void(void *, const JoWorld *, const uint32_t *, uint32_t, double *)", values))
        return self._kept[-1]

    def _action(self, function: Callable[..., Any], acting: Callable[[bool], None]) -> Any:
        def act(_context: Any, world: Any, agent: Any, numbers: Any, count: int) -> None:
            acting(True)
            try:
                function(lib.jo_agent_state(world, agent).id, [numbers[n] for n in range(count)])
            except BaseException as error:  # pylint: disable=broad-except
                self.failure = self.failure or error
            finally:
                acting(False)

        self._kept.append(ffi.callback("void(void *, JoWorld *, JoAgent, const double *, uint32_t)", act))
        return self._kept[-1]
