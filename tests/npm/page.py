"""page.py FOLDER [PICTURE]: serves a folder, opens its page in a browser, and checks that it draws people who move."""
import functools
import http.server
import sys
import threading
import time

from selenium import webdriver

folder = sys.argv[1]
# Counts the pixels of a picture that have a colour, as people do and floor and sky do not.
COUNT = """
const [picture, done] = arguments, image = new Image();
image.onload = () => {
    const canvas = new OffscreenCanvas(image.width, image.height), context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, image.width, image.height);
    let coloured = 0;
    for (let p = 0; p < data.length; p += 4) {
        const [r, g, b] = data.subarray(p, p + 3);
        coloured += Math.max(r, g, b) - Math.min(r, g, b) > 60;
    }
    done(coloured);
};
image.src = `data:image/png;base64,${picture}`;
"""


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
    if len(sys.argv) > 2:
        driver.save_screenshot(sys.argv[2])
    coloured = driver.execute_async_script(COUNT, driver.get_screenshot_as_base64())
    errors = [entry["message"] for entry in driver.get_log("browser") if entry["level"] == "SEVERE" and "favicon" not in entry["message"]]
    good = seconds >= 1.0 and coloured > 300 and not errors
    print("ok" if good else "not ok", f"page draws 500 people who move ({seconds:.1f} s, {coloured} pixels)")
    for error in errors:
        print(error)
finally:
    driver.quit()
    server.shutdown()
