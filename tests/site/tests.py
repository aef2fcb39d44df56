"""Tests of the playground in a browser, as a file server gives it to one: below a sub-folder, without headers of ours."""
import base64
import io
import os
import sys
import zipfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "page"))

from selenium.webdriver.common.keys import Keys  # noqa: E402

from harness import ROOT, expect, run_all, wait_for  # noqa: E402
from server import BELOW, Server  # noqa: E402

SMALL = (960, 600)  # the workbench side by side, with a small picture


class Workbench:
    """The workbench in the browser, and short ways to use it."""

    def __init__(self, browser, server, fragment, errors=False):
        self.browser = browser
        browser.size(*SMALL)
        browser.draw_few(2)
        browser.driver.get("about:blank")  # a change of the fragment alone opens no page
        browser.driver.get(server.address(f"workbench.html#{fragment}"))
        self.wait("return window.desk && desk.words.words.length > 0 && desk.problems !== undefined", "the editor is not there")
        if not errors:
            self.wait("return performance.getEntriesByName('moved').length", "the crowd does not move")

    def run(self, script, *arguments):
        return self.browser.run(script, *arguments)

    def wait(self, script, text, *arguments):
        try:
            return self.browser.wait(script, text, *arguments)
        except Exception as error:
            told = self.run("return ['notice', 'outcome', 'problems'].map((id) => document.getElementById(id)?.textContent).join(' | ')")
            raise type(error)(f"{error}; told: {told}") from None

    def outcome(self, *texts):
        """Waits until the outcome of what was done holds all texts."""
        self.wait("const told = document.getElementById('outcome').textContent; return arguments[0].every((t) => told.includes(t))",
                  f"the outcome has not {texts}", texts)

    def text(self, path):
        return self.run("return desk.texts[arguments[0]]", path)

    def write(self, path, was, now):
        """Replaces a part of a file, as an edit."""
        text = self.text(path)
        expect(was in text, f"{path} has no {was!r}")
        self.run("desk.replace(arguments[0], arguments[1])", path, text.replace(was, now))

    def save(self):
        """Saves by the keys of the editor."""
        self.run("desk.editor.view.focus()")
        self.browser.driver.switch_to.active_element.send_keys(Keys.CONTROL, "s")

    def press(self, text):
        self.browser.button(text).click()

    def frame(self, script, *arguments):
        """Runs a script in the page that shows the crowd."""
        return self.run(f"return document.getElementById('crowd').contentWindow.eval(arguments[0])", f"(() => {{ {script} }})()", *arguments)


SERVER = Server()
LUA = "behaviours/dodgeball.lua"


def edits(browser):
    """Playground: errors at their column, saves with counts, undo, restart, kept work, a link, and no request leaves the origin"""
    bench = Workbench(browser, SERVER, "scene=dodgeball")
    expect(bench.run("return desk.path") == LUA, "the behaviour is not shown first")
    begun = bench.text(LUA)
    # What is typed is completed and checked.
    bench.run("const v = desk.editor.view, at = v.state.doc.toString().indexOf('face = ball'); v.dispatch({ selection: { anchor: at } }); v.focus()")
    browser.driver.switch_to.active_element.send_keys("appr")
    bench.wait("return [...document.querySelectorAll('.cm-completionLabel')].some((n) => n.textContent === 'approach')", "no word is completed")
    browser.driver.switch_to.active_element.send_keys(Keys.ESCAPE, Keys.BACKSPACE * 4)
    # The editor's label says how the keyboard leaves it, and so it does.
    label = bench.run("return desk.editor.view.contentDOM.getAttribute('aria-label')")
    expect("Escape, then Tab leaves" in label, f"the editor is called {label!r}")
    browser.driver.switch_to.active_element.send_keys(Keys.ESCAPE, Keys.TAB)
    expect(not bench.run("return desk.editor.view.hasFocus") and bench.text(LUA) == begun, "the keyboard does not leave the editor")
    bench.write(LUA, "steer = dodge(", "steer = dogde(")
    bench.wait("return /dodgeball.lua:\\d+:\\d+.*dogde.*Did you mean 'dodge'/.test(document.getElementById('problems').textContent)", "the error is not listed with its place and way out")
    bench.run("desk.goTo(desk.problems[0])")
    bench.wait("return [...document.querySelectorAll('.cm-lintRange-error')].map((n) => n.textContent).join() === 'dogde'", "the word is not underlined")
    bench.save()
    bench.outcome("Not live: the version before keeps running")
    # A save, with people by state before and after, and back.
    bench.write(LUA, "steer = dogde(", "steer = dodge(")
    bench.write(LUA, "version = 6", "version = 7")
    bench.save()
    bench.outcome("dodgeball.lua is live", "People by state", "→")
    expect(bench.frame("return page.news.node.textContent.includes('dodgeball.lua is live')"), "the page does not tell of the reload")
    bench.write("scenes/dodgeball.yaml", "duration: 60", "duration: 70")  # unsaved: an undo of a save leaves it alone
    bench.press("Undo save")
    bench.outcome("dodgeball.lua is as before")
    expect(bench.text(LUA) == begun and bench.run("return desk.live[arguments[0]]", LUA) == begun, "the text before is not back")
    expect(bench.run("return desk.changed().join()") == "scenes/dodgeball.yaml", "the undo saved or lost what is unsaved")
    # What needs a restart is said so, and the restart is one press away.
    bench.write("scenes/dodgeball.yaml", "at: [[4, 0]]", "at: [[4, 0], [5, 2]]")
    bench.save()
    bench.outcome("At the next start", "Restart, so that all of it counts")
    bench.press("Restart, so that all of it counts")
    bench.wait("return document.getElementById('crowd').contentWindow.page.crowd.everybody().length === 3", "the restart does not have three people")
    # What is written while a scene starts does not run, and is not taken for it.
    bench.run("const started = desk.restart(); desk.replace(arguments[0], arguments[1]); return started", LUA, begun + "-- more\n")
    expect(bench.run("return desk.changed().join()") == LUA, "what was written during a restart counts as saved")
    bench.write(LUA, "-- more\n", "")
    # After the end of a run a save is one press away from being seen.
    bench.write("scenes/dodgeball.yaml", "duration: 70", "duration: 1")
    bench.run("return desk.restart()")
    bench.wait("return desk.isOver", "the run does not end")
    bench.write(LUA, "version = 6", "version = 7")
    bench.save()
    bench.outcome("dodgeball.lua is live", "The run is over: restart")
    bench.write("scenes/dodgeball.yaml", "duration: 1", "duration: 70")
    bench.write(LUA, "version = 7", "version = 6")
    bench.press("The run is over: restart")
    bench.wait("return desk.changed().length === 0 && !desk.isOver", "the restart does not count")
    # Names that a zip could not carry are refused; a file that is removed can be put back.
    for name, told in (("/a.lua", "is named like"), ("scenes/dodgeball.yaml/a.lua", "is a file, and the folder of")):
        bench.run("desk.files.add(arguments[0])", name)
        bench.outcome(told)
    bench.run("desk.show(arguments[0]); desk.files.remove(arguments[0])", LUA)
    bench.press("Put it back")
    expect(bench.text(LUA) == begun, "the file that was removed is not back")
    # The link has the whole edit; what is left unshared is kept, and told.
    link = bench.run("return desk.share.link()")
    bench.write(LUA, "version = 6", "version = 8")
    browser.driver.get("about:blank")
    # The first page lists it, with its address.
    browser.driver.get(SERVER.address("index.html"))
    expect(bench.run("return [...document.querySelectorAll('#kept a')].map((a) => a.getAttribute('href')).join()") == "workbench.html#scene=dodgeball", "kept work is not listed")
    bench = Workbench(browser, SERVER, "scene=dodgeball")
    bench.wait("return document.getElementById('notice').textContent.includes('is here again')", "work that comes back is not told")
    expect("version = 8" in bench.text(LUA), "the work is not back")
    bench.press("Discard it")
    bench.wait("return window.desk && desk.texts[arguments[0]] === arguments[1]", "the work is not discarded", LUA, begun)
    bench = Workbench(browser, SERVER, link.split("#")[1])
    expect("[[4, 0], [5, 2]]" in bench.text("scenes/dodgeball.yaml") and bench.text(LUA) == begun, "the link does not have the edit")
    # Work on a link is opened again without the link.
    bench.write(LUA, "version = 6", "version = 9")
    browser.driver.get(SERVER.address("index.html"))
    address = bench.run("return document.querySelector('#kept a').getAttribute('href')")
    bench = Workbench(browser, SERVER, address.split("#")[1])
    expect("version = 9" in bench.text(LUA), "work on a link is not opened from the list")
    bench.run("localStorage.clear()")
    # Where the browser forbids storage the workbench is the same, and says that nothing is kept.
    forbid = "for (const name of ['localStorage', 'sessionStorage']) Object.defineProperty(window, name, { get() { throw new DOMException('forbidden', 'SecurityError'); } })"
    hidden = browser.driver.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": forbid})["identifier"]
    bench = Workbench(browser, SERVER, "scene=dodgeball")
    bench.write(LUA, "version = 6", "version = 7")
    bench.save()
    bench.outcome("dodgeball.lua is live")
    bench.wait("return document.getElementById('notice').textContent.includes('This browser keeps nothing')", "it is not told that nothing is kept")
    browser.driver.execute_cdp_cmd("Page.removeScriptToEvaluateOnNewDocument", {"identifier": hidden})
    # Nothing was asked of another server; and without any, the crowd and the editor go on.
    asked = bench.run("return [window, document.getElementById('crowd').contentWindow].flatMap((w) => w.performance.getEntriesByType('resource').map((e) => e.name))")
    foreign = [name for name in asked if not name.startswith(SERVER.origin + BELOW) and not name.startswith(("blob:", "data:"))]
    expect(len(asked) > 8 and not foreign, f"requests to {foreign}")
    expect(not (complaints := browser.complaints()), f"the console says {complaints[:2]}")


def lessons(browser):
    """Playground: the lessons from the first step to the reader's own game, which is played, and on to the last one"""
    bench = Workbench(browser, SERVER, "lesson=1", errors=True)
    count = bench.run("return desk.lesson.lessons.length")
    for number in range(count):
        title = bench.run("return desk.lesson.lesson.title")
        bench.wait("return desk.lesson.number === arguments[0] && desk.lesson.list.childElementCount > 0", f"no lesson {number + 1}", number)
        expect(bench.run("return desk.lesson.node.dataset.done") == "false", f"{title}: it is done before it is begun")
        for button in bench.run("return [...document.querySelectorAll('.lesson figcaption button')]"):
            bench.run("arguments[0].click()", button)
        if title == "To the ball":
            wait_for(lambda: bench.run("return !desk.problems.some((p) => p.severity === 'error')"), "the files have errors")
        bench.save()
        bench.wait("return desk.changed().length === 0 || !document.getElementById('outcome').hidden", "nothing was saved")
        if title in ("Two against two, with three balls", "A game that you play"):  # new bodies and a player need a restart
            bench.outcome("Restart")
            bench.press("Restart")
        if title == "Why not?":
            bench.frame("page.connection.send({ do: 'inspect', find: '1' }); page.connection.send({ do: 'pause', on: true })")
        if title == "A game that you play":
            bench.wait("const p = document.getElementById('crowd').contentWindow.page; return p.scene?.game && !p.game.card.hidden", "the game has no start card")
            bench.frame("page.game.card.querySelector('button.main').click()")
            bench.wait("return document.getElementById('crowd').contentWindow.page.game.playing", "no round begins")
            bench.frame("page.player.press?.('d'); const on = (type) => document.body.dispatchEvent(new KeyboardEvent(type, { key: 'd', code: 'KeyD', bubbles: true })); on('keydown')")
        bench.wait("return desk.lesson.node.dataset.done === 'true'", f"{title} is not done")
        if title == "A game that you play":
            expect("That is your game" in bench.run("return desk.lesson.done.textContent"), "the game's end is not told")
        if number < count - 1:
            bench.press("Next lesson")
    expect("That was the last lesson" in bench.run("return desk.lesson.done.textContent"), "the end is not told")
    bench.run("history.replaceState(null, '', '#edit=a'); desk.opened.name = 'link:1'; desk.lesson.tellAddress()")
    expect(bench.run("return location.hash") == "#edit=a", "a link of a lesson loses its address, and a reload its files")
    bench.run("localStorage.clear()")
    expect(not (complaints := browser.complaints()), f"the console says {complaints[:2]}")


def start(browser):
    """Playground: the gallery finds scenes, its links lead to crowds that move, mods are turned on, archives opened, and all that without a server"""
    browser.size(*SMALL)
    browser.driver.get(SERVER.address("index.html"))
    browser.wait("return /^\\d+ scenes$/.test(document.getElementById('found').textContent)", "the scenes are not counted")
    browser.find("#find").send_keys("pilgrims queue")
    browser.wait("return [...document.querySelectorAll('.card')].filter((c) => !c.hidden).length === 1", "one scene is not found")
    scenes = len([name for name in os.listdir(os.path.join(ROOT, "scenes")) if name.endswith(".yaml")])
    expect(browser.run("return document.querySelectorAll('.card').length") == scenes, "a scene is missing")
    broken = browser.run("return Promise.all([...document.querySelectorAll('.card img')].map(async (i) => ((await fetch(i.src)).ok ? null : i.src))).then((all) => all.filter(Boolean))")
    expect(not broken, f"previews are missing: {broken}")
    # Where a server's headers allow it, a step has several threads.
    isolated = Server(isolated=True)
    bench = Workbench(browser, isolated, "scene=dodgeball")
    threads = bench.run("return desk.threads")
    expect(threads == min(os.cpu_count(), 8), f"{threads} threads on {os.cpu_count()} processors")
    bench.write(LUA, "version = 6", "version = 7")
    bench.save()
    bench.outcome("dodgeball.lua is live")
    bench.run("localStorage.clear()")
    isolated.stop()
    bench = Workbench(browser, SERVER, "scene=no-such-scene")
    bench.wait("return document.getElementById('notice').textContent.includes('There is no scene \"no-such-scene\"')", "a scene that is not there is not told")
    bench = Workbench(browser, SERVER, "scene=dodgeball")
    bench.run("document.getElementById('add').open = true")
    bench.wait("return [...document.querySelectorAll('#add button')].some((b) => b.textContent === 'Use the mod doubles')", "the mod is not offered")
    bench.press("Use the mod doubles")
    bench.outcome("The scene turns the mod doubles on")
    expect("scenes/mods/doubles/mod.yaml" in bench.run("return Object.keys(desk.texts)"), "the mod's files are not there")
    bench.press("Restart")
    bench.wait("return document.getElementById('crowd').contentWindow.page.crowd.everybody().length === 4", "the mod does not count")
    # An archive of another program is opened, and what its behaviour prints is shown.
    archive = io.BytesIO()
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as packed:
        packed.writestr("game/talk.lua", 'return machine { name = "talk", version = 1, start = "A", states = { A = {\n  steer = function(me) return me.x + nil, 0 end,\n  on_enter = function() print "here I am" end } } }\n')
        packed.writestr("game/picture.png", bytes(range(256)))
        packed.writestr("game/talk.yaml", "jostle: 1\ntitle: Talk\ngroups: {one: {behaviour: talk.lua, at: [[0, 0]]}}\n")
    bench.run("desk.share.openZip(new File([Uint8Array.from(atob(arguments[0]), (c) => c.charCodeAt(0))], 'talk.zip'))", base64.b64encode(archive.getvalue()).decode())
    bench.outcome("talk.zip is opened", "Left out, as they are no texts: game/picture.png")
    bench.wait("return document.getElementById('title').textContent === 'Talk' && document.querySelector('#said pre').textContent.includes('here I am')", "what is printed is not shown")
    # An error of a function is among the errors, at its line, until it is mended; the file is renamed, also in the scene.
    bench.wait("return /talk.lua:2 .*arithmetic on a nil value.*while it runs/.test(document.getElementById('problems').textContent)", "an error of a function is not among the errors")
    bench.run("desk.show('game/talk.lua'); desk.files.rename('game/talk.lua', 'rédt.lua')")
    expect("behaviour: rédt.lua" in bench.text("game/talk.yaml") and bench.run("return desk.path") == "game/rédt.lua", "the file is not renamed in the scene")
    bench.write("game/rédt.lua", "me.x + nil", "0")
    bench.press("Restart")
    bench.outcome("Started anew")
    bench.wait("return document.getElementById('problems').hidden", "an error that is mended stays")
    # A version from before the renaming comes back under the new name.
    bench.press("Undo save")
    bench.outcome("rédt.lua is as before")
    expect("me.x + nil" in bench.text("game/rédt.lua") and "behaviour: rédt.lua" in bench.text("game/talk.yaml"), "what ran before the renaming is not back")
    bench.write("game/rédt.lua", "me.x + nil", "0")
    bench.write("game/talk.yaml", "title: Talk", "title: Talks")
    bench.run("desk.files.add('none.lua'); return desk.save()")
    bench.outcome("Nothing that runs reads game/none.lua", "talk.yaml is live")
    bench.run("document.getElementById('share').open = true")
    bench.press("Back to what was here before")
    bench.wait("return desk.scene === 'scenes/dodgeball.yaml' && desk.live && 'scenes/mods/doubles/mod.yaml' in desk.texts", "what the archive replaced is not back")
    bench.run("desk.share.openZip(new File(['no zip'], 'bad.zip'))")
    bench.outcome("bad.zip was not opened: this is no zip archive")
    bench.run("localStorage.clear()")
    bench = Workbench(browser, SERVER, "scene=dodgeball")
    # Without a server the site opens all the same, with scenes that were not opened before.
    bench.wait("navigator.serviceWorker.ready.then(({ active }) => (window.kept = active?.state)); return window.kept === 'activated'", "the files are not kept")
    SERVER.stop()
    bench = Workbench(browser, SERVER, "scene=rescue")
    bench.write("behaviours/rescuer.lua", "version = 2", "version = 3")
    bench.save()
    bench.outcome("rescuer.lua is live")
    bench.run("localStorage.clear()")


if __name__ == "__main__":
    sys.exit(run_all([edits, lessons, start], sys.argv[1:]))
