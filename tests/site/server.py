"""A plain file server of the playground, below a sub-folder and without headers of ours."""
import functools
import http.server
import os
import threading

from harness import ROOT

SITE = os.path.abspath(os.environ.get("SITE", os.path.join(ROOT, "build", "site")))
BELOW = "/some/folder"  # the site is not at the server's root


class Server:
    """A plain file server of the site below a sub-folder; `isolated`: with the headers by which pages may have threads."""

    def __init__(self, isolated=False):
        class Handler(http.server.SimpleHTTPRequestHandler):
            def translate_path(self, path):
                path = path.split("?")[0].split("#")[0]
                inside = path[len(BELOW):] if path.startswith(BELOW + "/") else "/outside-of-the-site"
                return super().translate_path(inside)

            def end_headers(self):
                if isolated:
                    self.send_header("Cross-Origin-Opener-Policy", "same-origin")
                    self.send_header("Cross-Origin-Embedder-Policy", "require-corp")
                super().end_headers()

            def log_message(self, *_):
                pass

        self.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Handler, directory=SITE))
        self.thread = threading.Thread(target=self.server.serve_forever, daemon=True)
        self.thread.start()
        self.origin = f"http://127.0.0.1:{self.server.server_address[1]}"

    def address(self, path):
        return f"{self.origin}{BELOW}/{path}"

    def stop(self):
        self.server.shutdown()
        self.server.server_close()
