// A game's loop in C++: a scene, somebody who spawns, columns and events as ranges, errors as exceptions.
#include <cstdio>
#include <jostle.hpp>

int main() {
    try {
        jostle::Scene scene("scenes/evacuation.yaml");
        jostle::WorldRef world = scene.world();
        const auto x = world.column<float>("x"), y = world.column<float>("y");
        const JoAgent player = world.spawn("hall", x[0], y[0]);
        unsigned transitions = 0, touches = 0;
        for (int frame = 0; frame < 60; frame++) {
            scene.step();
            const jostle::Events events = world.events();
            transitions += static_cast<unsigned>(events.transitions.size());
            for (const JoTouchEvent &touch : events.touches)
                touches += touch.began && touch.kind == JO_TOUCHED_AGENT;
        }
        const JoAgentState at = jo_agent_state(world.get(), player);
        std::printf("t = %.1f s: %zu within 2 m of (%.2f, %.2f), %u transitions, %u touches\n", world.time(),
                    world.neighbours(at.x, at.y, 2).size(), at.x, at.y, transitions, touches);

        const auto figures = scene.figures();
        std::printf("%g people, %g transitions in all, %u troubles\n", jo_figure(figures.get(), "agents"),
                    jo_figure(figures.get(), "events.transitions"), scene.troubles()->count);
        if (jo_figure(figures.get(), "events.transitions") < transitions || figures->count < 40)
            return 1;

        jostle::World plain;
        JoAgentDef person = jo_default_agent_def();
        jo_agent_set_preferred(plain.get(), plain.add(person), 1, 0);
        plain.step(20);
        if (!(plain.column<float>("x")[0] > 0.8f))
            return 1;
    } catch (const jostle::Error &error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
    try {
        jostle::Scene("scenes/nowhere.yaml");
    } catch (const jostle::Error &error) {
        std::printf("as it should be: %s\n", error.what());
        return 0;
    }
    return 1;
}
