"""Tests of the package `jostle`, with small scenes and few steps."""
import copy
import pickle
import sqlite3
import threading
import time

import numpy as np
import pytest

import jostle

BEHAVIOUR = """local mine = memory { hits = 0 }
return machine { name = "walker", version = 1, start = "Walk",
  defaults = { speed = normal(1.2, 0.2) },
  states = {
    Walk = { steer = seek(own.goal), { to = "Call", when = mine.hits:above(2) } },
    Call = { steer = hold, signal = "here" },
  } }
"""
SCENE = """jostle: 1
step: 0.05
duration: 2
seed: 5
places: {west: {point: [-20, 0]}, east: {point: [20, 0]}}
walls: [{line: [[30, -5], [30, 5]], name: gate}]
groups: {people: {behaviour: walker.lua, at: [[0, 0], [1, 0.1], [2, -0.3], [3, 0.2]], set: {goal: west}}}
probes: {line: {flow: [[-1, -5], [-1, 5]]}}
"""


@pytest.fixture
def path(tmp_path):
    (tmp_path / "walker.lua").write_text(BEHAVIOUR)
    (tmp_path / "scene.yaml").write_text(SCENE)
    return tmp_path / "scene.yaml"


def test_steps_and_columns(path):
    with jostle.Scene(path) as scene:
        assert len(scene) == 4 and scene.dt == 0.05 and scene.tick == 0
        scene.step(3)
        assert scene.tick == 3 and scene.time == pytest.approx(0.15)
        x = scene["x"]
        assert x.dtype == np.float32 and not x.flags.writeable
        agent = scene.agent(2)
        assert x[list(scene["id"]).index(2)] == np.float32(agent.position[0])
        assert set(scene.columns()) >= {"id", "x", "radius", "speed"}
        assert scene.positions().shape == (4, 2)
        assert list(scene.states()) == ["Walk"] * 4
        assert set(scene.table()) >= {"id", "x", "y"}
        with pytest.raises(KeyError):
            scene["no such column"]
        scene.run()
        assert scene.time == pytest.approx(2.0)


def test_the_same_input_gives_the_same_state(path):
    hashes = {jostle.Scene(path, seed=7, threads=threads).run(1).hash for threads in (1, 2)}
    assert len(hashes) == 1
    assert jostle.Scene(path, seed=8).run(1).hash not in hashes
    assert set(jostle.Scene(path, set={"groups.people.set.mass": 90})["mass"]) == {90}


def test_errors_have_their_place(path):
    (path.parent / "walker.lua").write_text(BEHAVIOUR.replace("hold", "hald"))
    said = []
    with pytest.raises(jostle.Error) as error:
        jostle.Scene(path, message=said.append)
    assert error.value.file.endswith("walker.lua") and error.value.line == 6 and error.value.code == 3
    assert "hald" in error.value.text and "Did you mean 'hold'?" in error.value.text and "Did you mean 'hold'?" in "".join(said)
    assert str(error.value) == f"{error.value.file}:6:{error.value.column}: {error.value.text}" and error.value.column > 1
    again = pickle.loads(pickle.dumps(error.value))
    assert str(again) == str(error.value) and again.line == 6
    with pytest.raises(jostle.Error):
        jostle.Scene(path.parent / "none.yaml", message=said.append)


def test_shipped_scenes_have_names(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    scene = jostle.Scene("evacuation")
    assert str(scene.path) == str(jostle.data_folder() / "scenes" / "evacuation.yaml") and len(scene) > 10
    (tmp_path / "circle").write_text("jostle: 1\n")  # a file of that name goes first
    with pytest.raises(jostle.Error, match="circle"):
        jostle.Scene("circle", message=lambda text: None)
    with pytest.raises(jostle.Error, match="no shipped scene 'evacuatoin'; did you mean 'evacuation'"):
        jostle.Scene("evacuatoin")
    with pytest.raises(jostle.Error, match="no shipped scene 'xyzzy'; they are in /"):
        jostle.Scene("xyzzy")


def test_a_scene_is_neither_copied_nor_pickled(path):
    scene = jostle.Scene(path)
    for act in (copy.copy, copy.deepcopy, pickle.dumps):
        with pytest.raises(TypeError, match="load it anew"):
            act(scene)
    for whole in ([scene], scene.agent(1), {"scene": scene}):
        for act in (copy.deepcopy, pickle.dumps):
            with pytest.raises(TypeError, match="load it anew"):
                act(whole)
    with pytest.raises(jostle.Error, match="loaded already"):
        scene.__init__(path)
    assert copy.copy(scene.agent(1)).position == scene.agent(1).position
    scene.step(3)
    other = jostle.Scene(path)
    other.restore(scene.snapshot())  # the way that the error names
    assert other.hash == scene.hash and other.run(0.5).hash == scene.run(0.5).hash


def test_a_column_is_of_its_time(path):
    text = SCENE.replace("places: {", "sources: [{like: people, at: yard, rate: 200}]\nplaces: {yard: {point: [0, 20], radius: 14}, ")
    (path.parent / "grows.yaml").write_text(text)
    scene = jostle.Scene(path.parent / "grows.yaml")
    kept = {name: (scene[name], scene[name].copy()) for name in scene.columns() if len(scene[name])}
    scene.run(2)
    assert len(scene) > 100
    for column, was in kept.values():  # memory of the engine would be freed, or hold other numbers
        assert np.array_equal(column, was, equal_nan=column.dtype.kind == "f")
    x = scene["x"]
    with pytest.raises(ValueError):
        x[0] = 5
    x.flags.writeable = True
    x[:] = 5
    assert not np.any(scene["x"] == 5)
    scene.close()
    assert x[0] == 5


def test_odd_values_are_refused(path):
    scene = jostle.Scene(path)
    state = scene.hash
    nan, inf = float("nan"), float("inf")
    for act in (lambda: scene.step(-1), lambda: scene.run(-1), lambda: scene.run(nan), lambda: scene.run(inf),
                lambda: jostle.Scene(path, seed=-1), lambda: jostle.Scene(path, seed=2**64), lambda: jostle.Scene(path, threads=-1),
                lambda: jostle.Scene("a\0b"), lambda: scene.signal("a\0b"), lambda: scene.record("a\0b"),
                lambda: scene.record("a", every=nan), lambda: scene.record("a", every=-1),
                lambda: scene.neighbours(nan, 0, 1), lambda: scene.density(inf, 0), lambda: scene.cast((0,), (1, 1)),
                lambda: scene.add_wall("w", [(0, 0), (1,)]), lambda: scene.show(width=-1), lambda: scene.agent(0).push("a", 0)):
        with pytest.raises(ValueError):
            act()
    for act in (lambda: scene.step(1.5), lambda: scene.step("1"), lambda: scene.step(None), lambda: scene.run("1"),
                lambda: jostle.Scene(path, seed=1.5), lambda: jostle.Scene(path, mods="folder"), lambda: jostle.Scene(5),
                lambda: jostle.Scene(None), lambda: scene.signal(5), lambda: scene[5], lambda: scene.agent(1.5),
                lambda: scene.restore("text"), lambda: scene.spawn("people", "a", 0)):
        with pytest.raises(TypeError):
            act()
    for agent in (-1, 2**32, 2**70, 99):
        with pytest.raises(KeyError):
            scene.agent(agent)
    first = scene.agent(0)
    for act in (lambda: jostle.Scene(path, dt=nan, message=len), lambda: jostle.Scene(path, dt=-1, message=len),
                lambda: jostle.Scene(path, dt=0, message=len), lambda: jostle.Scene(path, threads=10**6, message=len),
                lambda: scene.record(path.parent), lambda: scene.log_input(path.parent),
                lambda: scene.spawn("people", nan, 0), lambda: scene.spawn("people", 1e9, 0), lambda: scene.spawn("peopel", 0, 0),
                lambda: scene.add_wall("w", []), lambda: scene.add_wall("w", [(nan, 0), (1, 1)]), lambda: scene.remove_wall("none"),
                lambda: scene.open("none"), lambda: scene.input(""), lambda: scene.input("push 0 nan 0"),
                lambda: first.teleport(nan, 0), lambda: first.push(inf, 0), lambda: first.set_goal(""),
                lambda: first.set_state("none"), lambda: first.set_memory("hits", nan), lambda: first.set_memory("none", 1),
                lambda: first.set_parameter("speed", nan), lambda: first.set_parameter("mass", -1),
                lambda: scene.restore(b""), lambda: scene.restore(scene.snapshot()[:-1])):
        with pytest.raises(jostle.Error) as error:
            act()
        assert error.value.text and error.value.code in (1, 2, 3)
    assert scene.hash == state and scene.step() is None


def test_numbers_of_numpy_are_numbers(path):
    scene = jostle.Scene(path, seed=np.int64(7), set={"groups.people.set.mass": np.float32(90), "duration": np.int64(3)})
    assert scene["mass"][0] == 90
    scene.step(np.int32(2))
    scene.agent(np.uint32(1)).push(np.float64(300), np.float32(0))
    assert scene.run(np.float32(0.5)).time == pytest.approx(0.6)


def test_a_message_may_not_use_its_scene(path):
    said = []

    def close(text):
        with pytest.raises(jostle.Error, match="under way"):
            scene.close()
        said.append(text)

    (path.parent / "walker.lua").write_text(BEHAVIOUR.replace('"here" }', '"here", on_enter = function(me) print "called" end }'))
    scene = jostle.Scene(path, message=close)
    scene.agent(0).set_memory("hits", 3)
    scene.step(2)
    assert "called" in "".join(said)


def test_recordings_of_others(tmp_path):
    path = tmp_path / "run #1?.sqlite"
    table = "(frame INTEGER, id INTEGER, pos_x REAL, pos_y REAL)"

    def write(*statements):
        path.unlink(missing_ok=True)
        database = sqlite3.connect(path)
        database.execute("CREATE TABLE metadata(key, value)")
        for statement in statements:
            database.execute(statement)
        database.commit()
        database.close()
        return jostle.Recording(path)

    good = write(f"CREATE TABLE trajectory_data{table}", "INSERT INTO trajectory_data VALUES (0, 1, 2.5, 3)")
    assert good["x"][0] == 2.5 and pickle.loads(pickle.dumps(good))["x"][0] == 2.5
    with pytest.raises(jostle.Error, match="frames a second"):
        good.fps
    with pytest.raises(jostle.Error, match="somebody's x is no number"):
        write(f"CREATE TABLE trajectory_data{table}", "INSERT INTO trajectory_data VALUES (0, 1, 'here', 3)")
    with pytest.raises(jostle.Error, match="no column for y"):
        write("CREATE TABLE trajectory_data(frame, id, pos_x)", "INSERT INTO trajectory_data VALUES (0, 1, 2)")
    with pytest.raises(jostle.Error, match="virtual table"):
        write("CREATE VIRTUAL TABLE trajectory_data USING fts5(frame, id, pos_x, pos_y)")


def test_what_is_done_and_what_happens(path):
    scene = jostle.Scene(path)
    scene.log_input(path.parent / "a.input")
    entered = scene.events().entered
    assert list(entered["agent"]) == [0, 1, 2, 3]
    scene.step()
    new = scene.spawn("people", 6, 2)
    new.set_goal("east")
    new.set_parameter("speed", 0.7)
    assert new.parameter("speed") == pytest.approx(0.7, abs=1e-6)
    scene.agent(0).set_memory("hits", 3)
    assert scene.agent(0).memory("hits") == 3
    scene.agent(1).push(300, 0)
    gone = scene.agent(3)
    gone.remove()
    scene.add_wall("barrier", [(-3, -5), (-3, 5)])
    scene.step()
    events = scene.events()
    assert events.transitions["agent"].tolist() == [0] and events.said["agent"].tolist() == [0]
    assert events.entered["agent"].tolist() == [4] and events.left["agent"].tolist() == [3]
    assert scene.agent(0).state == "Call"
    with pytest.raises(jostle.Error, match="has left"):
        gone.position
    with pytest.raises(jostle.Error, match="Did you mean 'west'"):
        new.set_goal("wst")
    with pytest.raises(KeyError):
        new.memory("none")
    scene.run(0.5)
    state = scene.hash
    scene.finish()
    replay = jostle.Scene(path, input_log=path.parent / "a.input")
    replay.step(scene.tick)
    assert replay.hash == state


def test_questions(path):
    scene = jostle.Scene(path)
    scene.step()
    ids, distances = scene.neighbours(0, 0, 1.5)
    assert ids[0] == 0 and np.all(np.diff(distances) >= 0)
    hit = scene.cast((25, 0), (35, 0), agents=False)
    assert hit.kind == "wall" and hit.share == pytest.approx(0.5, abs=1e-3) and hit.normal[0] == pytest.approx(-1)
    assert scene.cast((25, 3), (27, 3)) is None
    assert scene.cast((10, 0.2), (0, 0.2), radius=0.1).what == 3
    way = scene.way(35, 0, "west")
    length = np.hypot(*np.diff(way, axis=0).T).sum()
    assert 56.5 < length < 58.5  # round an end of the wall
    assert scene.density(1, 0) > scene.density(12, 0)


STOREYS = """jostle: 1
step: 0.05
duration: 60
storeys: {ground: {height: 0}, first: {height: 3.5}}
stairs: {north: {from: ground, to: first, path: [[8, 2], [14, 2]], width: 1.5}}
walls:
  - {line: [[0, 9], [0, 0], [20, 0], [20, 12], [0, 12], [0, 11]]}
  - {line: [[0, 0], [20, 0], [20, 12], [0, 12]], closed: true, storey: first}
places:
  hall: {polygon: [[16, 1], [18, 1], [18, 3], [16, 3]], storey: first}
  street: {line: [[-2, 8], [-2, 12]]}
bodies: [{shape: {sphere: {radius: 0.2}}, mass: 2, at: [5, 5, 0.2], name: ball}]
groups: {people: {count: 3, in: hall, journey: [{exit: street}]}}
"""


def test_bodies_and_walls_of_storeys(path):
    path.write_text(STOREYS)
    scene = jostle.Scene(path)
    ball = scene.body("ball")
    ball.place((4, 6, 0.2), storey="first")
    scene.step(2)
    assert ball.position[:2] == pytest.approx((4, 6), abs=0.05)
    ball.impulse((4, 0, 0), (4, 6, 0.2), storey=1)
    scene.step(2)
    assert ball.velocity[0] > 1
    ball.place((3, 3, 0.2))
    scene.add_wall("shut", [(15, 0), (15, 12)], storey="first")
    for storey in ("cellar", 2):
        with pytest.raises(KeyError):
            ball.place((4, 6, 0.2), storey=storey)
        with pytest.raises(KeyError):
            scene.add_wall("other", [(15, 0), (15, 12)], storey=storey)


def test_storeys(path):
    path.write_text(STOREYS)
    scene = jostle.Scene(path)
    assert [one.name for one in scene.storeys] == ["ground", "first"] and scene.storeys[1].height == 3.5
    (stair,) = scene.stairs
    assert (stair.name, stair.lower, stair.upper, stair.width, stair.length, stair.closed) == ("north", 0, 1, 1.5, 6.0, False)
    where = scene.where()
    assert list(where["storey"]) == [1, 1, 1] and (where["height"] == 3.5).all() and (where["stair"] == 2**32 - 1).all()
    assert (scene.positions() <= [18, 3]).all() and (scene["y"] > 18).all()
    agent = scene.agents()[0]
    assert agent.storey == 1 and agent.where.stair is None and agent.position[1] < 3
    x, y = agent.position
    assert len(scene.neighbours(x, y, 3, storey="first")[0]) == 3 and len(scene.neighbours(x, y, 3)[0]) == 0
    assert scene.density(x, y, storey=1) > scene.density(x, y) == 0
    way = scene.way(17, 2, "street", storey="first")
    assert way.shape[1] == 3 and way[0, 2] == 1 and way[-1, 2] == 0 and np.ptp(way[:, 1]) < 12
    assert np.hypot(*np.diff(way[:, :2], axis=0).T).max() < 1
    agent.teleport(4, 5)
    assert agent.storey == 1
    agent.teleport(4, 5, storey="ground")
    assert agent.storey == 0 and agent.position == pytest.approx((4, 5))
    assert scene.spawn("people", 3, 3, storey=1).storey == 1
    with pytest.raises(KeyError):
        scene.neighbours(0, 0, 1, storey="cellar")
    with pytest.raises(KeyError):
        scene.spawn("people", 3, 3, storey=2)
    stairs = set()
    for _ in range(30):
        scene.step(20)
        stairs |= set(scene.where()["stair"].tolist())
    assert 0 in stairs and len(scene) < 4


def test_lifts(path):
    lift = "lifts: {east: {area: [[16, 8], [17.6, 9.8]], door: [[16, 8.4], [16, 9.4]], capacity: 4}}\n"
    path.write_text(STOREYS.replace("walls:", lift + "walls:", 1))
    scene = jostle.Scene(path)
    (east,) = scene.lifts
    assert (east.name, east.mode, east.capacity, east.people, east.storey, east.height) == ("east", "in_use", 4, 0, 0, 0.0)
    assert scene.agents()[0].where.lift is None and scene.agents()[0].where.ride == "none" and np.isnan(scene.where()["since"]).all()
    scene.set_lift("east", "out_of_use")
    scene.set_lift("all", "firemen")
    assert scene.lifts[0].mode == "firemen"
    with pytest.raises(ValueError):
        scene.set_lift("east", "broken")
    with pytest.raises(jostle.Error, match="there is no lift 'west'"):
        scene.set_lift("west", "in_use")


def test_a_scene_without_storeys_has_the_storey_0(path):
    scene = jostle.Scene(path)
    assert scene.storeys == [] and scene.stairs == [] and scene.agent(0).storey == 0
    assert (scene.where()["x"] == scene["x"]).all() and scene.way(0, 0, "west").shape[1] == 2
    with pytest.raises(KeyError):
        scene.density(0, 0, storey=1)


def test_snapshots(path):
    scene = jostle.Scene(path)
    scene.step(5)
    data = scene.snapshot()
    later = scene.run(0.5).hash
    scene.restore(data)
    assert scene.tick == 5 and scene.run(0.5).hash == later
    with pytest.raises(jostle.Error):
        scene.restore(data[:100])


def test_what_a_run_leaves(path):
    scene = jostle.Scene(path)
    scene.record(path.parent / "run.sqlite")
    scene.run()
    scene.finish()
    assert scene.summary()["agents"] == 4
    table = scene.probes()["line"]
    assert len(table) > 1 and all(isinstance(column, np.ndarray) for column in table.values())
    assert table["time [s]"].dtype == float and len({len(column) for column in table.values()}) == 1
    summary = scene.summary()
    assert isinstance(summary["events"]["hits"], int) and summary["mods"] == [] and len(summary["hash"]) == 16
    assert [entry["path"] for entry in summary["inputs"]][0] == str(path) and scene.troubles() == []
    recording = jostle.Recording(path.parent / "run.sqlite")
    assert recording.fps == 10 and set(recording["id"]) == {0, 1, 2, 3}
    frames = list(recording.frames())
    assert len(frames) >= 20 and sum(rows.stop - rows.start for _, rows in frames) == len(recording)
    assert recording.path_of(0)[-1] == pytest.approx(scene.agent(0).position, abs=0.15)
    with pytest.raises(jostle.Error):
        jostle.Recording(path)


def test_a_sweep(path):
    runs = jostle.sweep(path, {"groups.people.set.mass": [60, 90]}, seeds=(1, 2), seconds=0.2)
    assert runs.column("agents").tolist() == [4] * 4 and np.isnan(runs.column("no.such")).all()
    table = runs.table("agents")
    assert list(table["groups.people.set.mass"]) == [60, 60, 90, 90] and list(table["seed"]) == [1, 2, 1, 2]
    assert len({run["summary"]["hash"] for run in runs.runs}) == 4


def test_other_threads_run_while_it_steps(path):
    scene = jostle.Scene(path)
    counted, done = [0], threading.Event()

    def count():
        while not done.is_set():
            counted[0] += 1
            time.sleep(0)

    thread = threading.Thread(target=count)
    thread.start()
    scene.run(30)
    done.set()
    thread.join()
    assert counted[0] > 10


def test_a_closed_scene(path):
    scene = jostle.Scene(path)
    scene.close()
    with pytest.raises(jostle.Error, match="closed"):
        scene.step()
    assert "closed" in repr(scene)


def test_arrays_outlive_a_closed_scene(path):
    scene = jostle.Scene(path)
    scene.step(3)
    x = scene["x"]
    part, before = x[::2], x.copy()
    scene.close()
    del x
    others = [jostle.Scene(path) for _ in range(3)]  # which would take the memory
    assert np.array_equal(part, before[::2])
    with pytest.raises(jostle.Error, match="closed"):
        scene["x"]
    del part, others


def test_what_means_nothing_is_refused(path):
    scene = jostle.Scene(path)
    scene.step()
    state, odd = scene.hash, float("nan")
    for call, arguments in [(scene.neighbours, (odd, 0, 1)), (scene.neighbours, (0, 0, -1)), (scene.way, (1e5, 0, "west")),
                            (scene.density, (0, odd)), (scene.cast, ((0, odd), (1, 1))), (scene.cast, ((0, 0), (1, 1), -1)),
                            (scene.signal, ("go\0ne",)), (scene.open, ("gate\0",)), (scene.__getitem__, ("x\0",)),
                            (scene.input, ("push 0 1 1\0",)), (jostle.Scene, (f"{path}\0",))]:
        with pytest.raises(ValueError):
            call(*arguments)
    for call, arguments in [(scene.signal, (b"go",)), (scene.body, (5,)), (scene.density, ("x", 0)), (scene.restore, ("x",))]:
        with pytest.raises(TypeError):
            call(*arguments)
    assert scene.hash == state
    scene.finish()
    for call, arguments in [(scene.step, ()), (scene.input, ("push 0 1 1",))]:
        with pytest.raises(jostle.Error, match="finished"):
            call(*arguments)


WORDY = """return machine { name = "walker", version = 1, start = "Walk", states = {
  Walk = { steer = seek(own.goal), speed = pace, { to = "Rest", when = far_out } },
  Rest = { steer = hold, on_enter = function(me) ring(me.id, 2) end } } }
"""


def test_behaviours_use_words_of_the_program(path):
    (path.parent / "walker.lua").write_text(WORDY)
    rung = []
    words = [jostle.Word("pace", lambda columns: 1 + 0 * columns["x"], "how fast people walk", "pace:above(2)", unit="m/s"),
             jostle.Word("far_out", lambda columns: columns["x"] > 2.5, "whether an agent is far", "far_out", "condition"),
             jostle.Word("ring", lambda agent, numbers: rung.append((agent, numbers, len(scene))), "rings", "ring(2)", "action")]
    with pytest.raises(jostle.Error, match="unknown word 'pace'"):
        jostle.Scene(path, message=lambda text: None)
    scene = jostle.Scene(path, words=words)
    scene.step(2)
    assert rung == [(3, [3.0, 2.0], 4)]
    assert list(scene.states()).count("Rest") == 1
    scene.close()
    with pytest.raises(jostle.Error, match="the language has a word of this name"):
        jostle.Scene(path, words=[jostle.Word("after", None, "m", "after")], message=lambda text: None)

    def wrong(columns):
        raise RuntimeError("no pace")

    scene = None
    with pytest.raises(RuntimeError, match="no pace"):
        scene = jostle.Scene(path, words=[words[0]._replace(function=wrong), *words[1:]])
        scene.step(2)
