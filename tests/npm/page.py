"""page.py FOLDER: serves a folder, opens its page in a browser, and checks that it draws people who move."""
import functools
import http.server
import sys
import threading
import time

from selenium import webdriver

folder = sys.argv[1]


class Quiet(http.server.SimpleHTTPRequestHandler):
    extensions_map = {**http.server.SimpleHTTPRequestHandler.extensions_map, ".mjs": "text/javascript", ".wasm": "application/wasm"}

    def log_message(self, *words):
        pass


server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=folder))
threading.Thread(target=server.serve_forever, daemon=True).start()
options = webdriver.ChromeOptions()
for option in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--window-size=480,360", "--enable-unsafe-swiftshader"):
    options.add_argument(option)
options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
driver = webdriver.Chrome(options=options)
try:
    driver.get(f"http://127.0.0.1:{server.server_port}/")
    seconds, end = 0.0, time.time() + 120
    while seconds < 1.0 and time.time() < end:
        time.sleep(0.2)
        title = driver.title
        if title.startswith("500 people"):
            seconds = float(title.split(",")[1].split()[0])
    picture = driver.get_screenshot_as_png()
    if len(sys.argv) > 2:
        with open(sys.argv[2], "wb") as file:
            file.write(picture)
    errors = [entry["message"] for entry in driver.get_log("browser") if entry["level"] == "SEVERE" and "favicon" not in entry["message"]]
    drawn = len(picture) > 20000  # of a picture without people some 5,000
    print("ok" if seconds >= 1.0 and drawn and not errors else "not ok", f"page draws 500 people who move ({seconds:.1f} s, {len(picture)} bytes)")
    for error in errors:
        print(error)
finally:
    driver.quit()
    server.shutdown()
