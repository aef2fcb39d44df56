"""What stays as it is: materials over scene messages, figures that are nothing, what a scene is about."""
import os
import subprocess

from harness import JOSTLE, Session, expect, served, temporary_copy


@served("run", "scenes/wall-breaking.yaml", "--view")
def materials_stay(browser):
    """walls that a scene message brings anew are drawn by the programs that are there"""
    materials = "return page.view.ground.decks[0].group.children.map((child) => child.material.uuid)"
    programs = "return page.view.renderer.info.programs.map((program) => program.id)"
    again = "page.view.ground.build(page.view.shown, page.view.storeys); page.take({ ...page.scene, type: 'scene' }); page.view.dirty = true; page.view.draw(performance.now());"
    browser.size(400, 300)  # in a small picture few people are meshes
    browser.run(again)
    before, compiled = browser.run(materials), browser.run(programs)
    expect(len(before) > 2, f"there are {len(before)} parts")
    browser.run(again * 5)
    expect(browser.run(materials) == before, "materials are made anew")
    expect(browser.run(programs) == compiled, "programs are compiled anew")


@served("run", "scenes/circle.yaml", "--view")
def loading_note_goes(browser):
    """the loading note goes with the first picture"""
    browser.wait("return !document.getElementById('stage').classList.contains('empty')", "the picture stays hidden")
    expect(not browser.find("#loading").is_displayed() and browser.find("#picture").is_displayed(), "the loading note stays")


@served("run", "scenes/circle.yaml", "--view")
def tabs_keep_their_places(browser):
    """tabs keep their places when others are selected and when a person is chosen"""
    places = "return [...document.querySelectorAll('#tabs button')].filter((tab) => !tab.hidden).map((tab) => tab.getBoundingClientRect().left + ',' + tab.getBoundingClientRect().top + ',' + tab.offsetWidth)"
    before = browser.run(places)
    expect(len(before) > 4, f"there are {len(before)} tabs")
    for name in ("machine", "charts", "scene"):
        browser.run(f"page.panel.show('{name}')")
        expect(browser.run(places) == before, f"with {name} selected they are at {browser.run(places)}, before at {before}")
    browser.run("page.inspect(0)")
    expect(browser.run(places) == before, "with a person chosen they lie elsewhere")


def recordings_say_about(browser):
    """the page of a recording says what its scene is about"""
    folder = temporary_copy({})
    recording = os.path.join(folder, "run.sqlite")
    subprocess.run([JOSTLE, "run", "scenes/circle.yaml", "--for", "2", "--record", recording, "--quiet"], check=True)
    session = Session("view", recording)
    try:
        browser.open(session)
        with open("scenes/circle.yaml", encoding="utf-8") as scene:
            about = next(line for line in scene if line.startswith("about:"))[6:].strip().strip('"')
        expect(browser.run("return page.scene.about") == about, "the replay says: " + browser.run("return page.scene.about"))
    finally:
        session.stop()


TESTS = [materials_stay, loading_note_goes, tabs_keep_their_places, recordings_say_about]
