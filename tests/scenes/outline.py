"""Prints what a report says of itself: sections, captions and heads of tables of its page, and titles, axes and
ranges of its plots. `outline.py FOLDER` has ranges too, `outline.py FOLDER --no-ranges` leaves out what depends on the run."""
import glob, html.parser, os, re, sys

folder, ranges = sys.argv[1], "--no-ranges" not in sys.argv

class Page(html.parser.HTMLParser):
    def __init__(self):
        super().__init__()
        self.kept, self.text, self.heads = None, "", []
    def handle_starttag(self, tag, attributes):
        if tag in ("h1", "h2", "h3", "figcaption", "b", "th"):
            self.close_head(tag)
            self.kept, self.text = tag, ""
        elif tag in ("td", "table"):
            self.close_head(tag)
    def close_head(self, tag):
        if self.kept == "th":
            self.heads.append(" ".join(self.text.split()))
        if self.heads and tag != "th":
            print("  table: " + " | ".join(self.heads))
            self.heads = []
        self.kept = None
    def handle_data(self, data):
        self.text += data
    def handle_endtag(self, tag):
        if tag == "thead":
            self.close_head(tag)
        if tag != self.kept or tag == "th":
            return
        text = " ".join(self.text.split())
        if not ranges:
            text = re.sub(r"\d+(\.\d+)?", "N", text)
        print({"h1": "= ", "h2": "== ", "h3": "=== ", "b": "  sentence: ", "figcaption": "  picture: "}[tag] + text)
        self.kept = None

with open(os.path.join(folder, "index.html"), encoding="utf-8") as file:
    Page().feed(file.read())
wanted = ("title", "xlabel", "ylabel", "cblabel", "multiplot") + (("xrange", "yrange", "cbrange") if ranges else ())
for path in sorted(glob.glob(os.path.join(folder, "*.plt"))):
    print("plot " + os.path.basename(path)[:-4])
    with open(path, encoding="utf-8") as file:
        script = file.read().split("\nreset\n")[0]  # the second is the same for the other terminal
    for line in script.splitlines():
        if re.match(r"set (%s)\b" % "|".join(wanted), line):
            print("  " + line[4:])
        elif ranges:
            print("".join("  named: %s\n" % name for name in re.findall(r" title '([^']*)'", line)), end="")
for path in sorted(glob.glob(os.path.join(folder, "*.svg"))):
    with open(path, encoding="utf-8") as file:
        text = file.read()
    if 'id="legend"' not in text:
        continue  # by gnuplot, told above
    print("drawing " + os.path.basename(path)[:-4])
    for words in re.findall(r"<text[^>]*>([^<]*)</text>", text):
        print("  " + (words if ranges else re.sub(r"[\d.]+", "N", words)))
