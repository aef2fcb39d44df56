"""Tests of states that run a machine of their own."""
from harness import expect, served
from selenium.webdriver.support.ui import Select


@served("run", "tests/data/nested.yaml", "--view")
def nested(browser):
    """states that run a machine: their sums in the legend, their parameters, the state of a person within"""
    browser.run("page.connection.send({do: 'pause', on: true})")
    browser.wait("return page.bar.paused", "no pause")
    first = browser.run("return [page.colour, page.scene.view.given, page.scene.states.length, page.scene.groups.length]")
    expect(first[2] <= 8 or first[0] in ("group", "outer"), f"people are coloured by {first[0]} at first, with {first[2]} states and {first[3]} groups")
    outer = browser.run("""page.colourBy('outer');
        page.legend.take(page.machine.status);
        return [...document.querySelectorAll('.legend li:not([hidden]) button')].map((b) => b.innerText.trim());""")
    browser.run("page.colourBy('state'); page.legend.take(page.machine.status)")
    sums = browser.wait("""const rows = [...document.querySelectorAll('.legend li:not([hidden])')].map((row) => row.textContent.split(' '));
        const of = (name) => rows.filter(([m, s]) => m === 'guard' && (s === name || (name === 'Guard.' && s.startsWith(name)))).map((r) => Number(r[2]));
        const [sum] = of('Guard'), parts = of('Guard.');
        return sum !== undefined && [sum, parts.reduce((a, b) => a + b, 0)];""", "no row for Guard in the legend")
    expect(sums[0] == sums[1] > 0, f"the sum and its parts are {sums}")
    expect(f"guard Guard {sums[0]}" in outer, f"by outer states the legend has {outer}, not {sums[0]} guards")
    kept = browser.run("""const button = [...document.querySelectorAll('.legend li:not([hidden]) button')][1], i = page.legend.buttons.indexOf(button), t = () => page.view.people.uniforms.colours.value.image.data;
        const colours = () => new Set([...Array(page.scene.states.length).keys()].map((k) => t().slice(4 * k, 4 * k + 3).join())).size, all = colours();
        button.click();
        const one = [colours(), button.getAttribute('aria-pressed')];
        button.click();
        return [all > 2, ...one, colours() === all];""")
    expect(kept == [True, 2, "true", True], f"a class alone does not keep its colour: {kept}")
    browser.find("#tab-parameters").click()
    machine, = [s for s in browser.driver.find_elements("css selector", "#page-parameters select") if "guard" in s.text][:1]
    Select(machine).select_by_visible_text("guard")
    browser.run("page.parameters.show(0, page.scene.machines[0].states.length)")
    state = Select(browser.driver.find_elements("css selector", "#page-parameters select")[1])
    expect(state.first_selected_option.text == "Guard, with all within it", f"{state.first_selected_option.text} is chosen")
    names = [option.text for option in state.options]
    expect(names == ["Greet", "Guard, with all within it", "Guard.End", "Guard.Look", "Guard.Walk", "Rest", "defaults"], f"the states are {names}")
    row = "document.querySelector('#page-parameters [data-parameter=push]')"
    expect("state Guard tests/data/nested/guard.lua:10" in browser.run(f"return {row}.textContent"), "it is not said who set push")
    browser.run(f"""const n = {row}.querySelector('[type=number]'); n.value = 33; n.dispatchEvent(new Event('change'))""")
    browser.wait("""return page.scene.machines[0].states[3].parameters.some((p) => p.name === 'push' && p.value === 33)""", "Guard.Walk does not take the value")
    browser.run("page.connection.input('set', 'guard', 'Guard.Look', 'push', 5)")
    browser.wait(f"return {row}.textContent.includes('Guard.Look sets its own')", "no word of the state that keeps its own")
    browser.picture("nested-parameters")
    browser.run("page.connection.send({do: 'inspect', find: 'Guard'})")
    browser.wait("return document.querySelector('#page-agent').textContent.includes('program or page')", "the person's panel does not tell who set push")
    own = browser.run("return page.agentPage.ownPart.textContent")
    expect("speed" not in own, f"own values repeat parameters: {own}")
    browser.picture("nested-person")


TESTS = [nested]
