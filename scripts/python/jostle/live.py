"""Live pages in notebooks: of a scene that Python holds, and of recordings."""
from __future__ import annotations

import asyncio
import html
import os
import re
import sys
import threading
import time
import weakref
from typing import TYPE_CHECKING, Any, Callable, Optional, Union

from ._library import Error, check, ffi, lib, named, path_named, text_of

if TYPE_CHECKING:
    from .scene import Scene

__all__ = ["FRAMES", "LivePage", "RecordingPage"]

# Pages that may show a live page in a frame: notebooks of this machine, and those of editors.
FRAMES = "http://localhost:* http://127.0.0.1:* https://localhost:* https://127.0.0.1:* vscode-webview: vscode-file:"
IDLE = 0.2  # s between turns while no browser looks


def needs_tools() -> None:
    """Refuses where the library has no live pages, or no browser can reach them."""
    try:
        lib.jo_live_open
    except AttributeError:
        raise Error("live pages are in libjostle-tools, and libjostle was found alone; JOSTLE_LIBRARY may name it", 2) from None
    if "google.colab" in sys.modules:
        raise Error("a browser cannot reach live pages of Colab's machines: show the scene itself, or record it, download "
                    "the file, and run `jostle view FILE` on your machine", 2)


class _Page:
    """A frame that a notebook shows."""

    address = ""

    def __init__(self, width: Union[int, str], height: int) -> None:
        self.width, self.height = width, height

    @property
    def html(self) -> str:
        """The frame, and what to do where it stays empty."""
        port = re.sub(r"^.*:(\d+)/.*$", r"\1", self.address)
        far = "SSH_CONNECTION" in os.environ or "JUPYTERHUB_SERVICE_PREFIX" in os.environ
        forward = f"ssh -L {port}:127.0.0.1:{port} HOST"
        note = (f'Live page at port {port} of the kernel\'s machine, <a href="{html.escape(self.address)}" target="_blank" '
                'rel="noopener noreferrer">in a tab of its own</a>. ' +
                (f"<b>This kernel runs on another machine: forward the port first, by <code>{forward}</code>.</b>" if far else
                 f"If it stays empty, the kernel runs on another machine, or is gone: forward the port by <code>{forward}</code>, "
                 "or run the cell again."))
        return (f'<iframe src="{html.escape(self.address)}" width="{self.width}" height="{self.height}" title="Live page" '
                'style="border:1px solid #ccc;max-width:100%" allow="fullscreen; gamepad" referrerpolicy="no-referrer"></iframe>'
                f'<p style="font-size:small">{note}</p>')

    def _repr_html_(self) -> str:
        return self.html if self.is_open else "<p>The live page is closed.</p>"

    @property
    def is_open(self) -> bool:
        """Whether browsers can open it."""
        return False

    def __repr__(self) -> str:
        return f"<jostle live page {self.address}>" if self.is_open else "<jostle live page, closed>"


def _serve_again(reference: "weakref.ref[Scene]", loop: asyncio.AbstractEventLoop) -> None:
    """Serves a scene's page between cells, as long as both are there."""
    scene = reference()
    if scene is None or not scene._page:
        return
    wait = scene._serve_page()
    loop.call_later(wait, _serve_again, reference, loop)


class LivePage(_Page):
    """The live page of a scene: in a notebook a frame. `address` opens it in any browser of this machine.

    Python's steps are shown as they are made. Between cells, and in `serve`, people can let the scene run on the page and
    act on it: Python then finds it in the state that they left. The page ends with `stop`, or with its scene."""

    def __init__(self, scene: "Scene", width: Union[int, str], height: int) -> None:
        super().__init__(width, height)
        self.scene = scene
        self.address = text_of(lib.jo_live_address(scene._page))

    @property
    def is_open(self) -> bool:
        """Whether browsers can open it."""
        return bool(self.scene._page) and text_of(lib.jo_live_address(self.scene._page)) == self.address

    @property
    def watchers(self) -> int:
        """How many browsers show it."""
        return lib.jo_live_watchers(self.scene._page) if self.is_open else 0

    def serve(self, seconds: Optional[float] = None) -> None:
        """Lets people use the page for `seconds`, or until Ctrl-C: where no notebook does so between its cells."""
        until = time.monotonic() + seconds if seconds is not None else float("inf")
        try:
            while self.is_open and time.monotonic() < until:
                self.scene._serve_page(min(0.1, max(0.0, until - time.monotonic())))
        except KeyboardInterrupt:
            if seconds is not None:
                raise

    def stop(self) -> None:
        """Closes the page; the scene goes on."""
        if self.is_open:
            self.scene._close_page()


def open_page(scene: "Scene", frame: Optional[str], port: int, running: bool, watch: bool) -> Any:
    """Opens the page of a scene, and has it served between cells where there is a loop, as notebooks have."""
    needs_tools()
    definition = ffi.new("JoLiveDef *", lib.jo_default_live_def())
    kept = ffi.new("char[]", named(frame or FRAMES))
    definition.frame, definition.port, definition.running, definition.watch = kept, port, running, watch
    page = check(lib.jo_live_open(scene._scene, definition, scene._error), scene._error)
    try:
        loop = asyncio.get_running_loop()
    except RuntimeError:
        return page
    loop.call_soon(_serve_again, weakref.ref(scene), loop)
    return page


class RecordingPage(_Page):
    """The live page of a recording, served by a thread until `stop`, or until nobody holds this object."""

    def __init__(self, path: str, frame: Optional[str], port: int, width: Union[int, str], height: int) -> None:
        needs_tools()
        super().__init__(width, height)
        stop, said, opened = ffi.new("int *"), [], threading.Event()
        definition = ffi.new("JoViewRecordingDef *", lib.jo_default_view_recording_def())
        error = ffi.new("JoError *")

        def on_open(_context: Any, address: Any) -> None:
            said.append(text_of(address).strip())
            opened.set()

        kept = [ffi.new("char[]", path_named(path)), ffi.new("char[]", named(frame or FRAMES)),
                ffi.callback("void(void *, const char *)", on_open),
                ffi.callback("void(void *, const char *)", lambda _context, _text: None)]
        definition.recording, definition.frame, definition.port, definition.stop = kept[0], kept[1], port, stop
        definition.opened, definition.message = kept[2], kept[3]

        def serve() -> None:
            lib.jo_view_recording(definition, error)
            kept.clear()
            opened.set()

        thread = threading.Thread(target=serve, name="jostle recording page", daemon=True)
        thread.start()
        opened.wait()
        if not said:
            thread.join()
            check(False, error)
        self.address = said[0]
        self._thread = thread
        self._end: Callable[[], Any] = weakref.finalize(self, _end_thread, stop, thread)

    @property
    def is_open(self) -> bool:
        """Whether browsers can open it."""
        return self._thread.is_alive()

    def stop(self) -> None:
        """Closes the page."""
        self._end()


def _end_thread(stop: Any, thread: threading.Thread) -> None:
    stop[0] = 1
    thread.join()
