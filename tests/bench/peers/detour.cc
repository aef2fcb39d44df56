/* DetourCrowd and Jostle side by side: the same positions, goals, radii and speeds, in the same
   run, in turn. Prints ns of processor time per agent and step of both, and their ratio.

   DetourCrowd is given what each person of the scene is and wants: its velocity towards the goal is
   set before each step, as behaviours do it for Jostle, and is not timed. It walks on one large
   polygon, so that it has no paths to find and no walls. It knows no periodic edges: few steps are
   timed, in which people do not come far. What it does not do: contact, pushing, behaviours. */
#include <DetourCrowd.h>
#include <DetourNavMesh.h>
#include <DetourNavMeshBuilder.h>
#include <jostle.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

namespace {

const int WARM_UP = 20, STEPS = 60, ROUNDS = 5;
const float HALF = 1500.0f; // m: of the polygon's side
const float HEIGHT = 1.8f;  // m, of a person

struct Person {
    float x, y, radius, speed, max_speed;
    float goal_x, goal_y; // m
};
struct Scene {
    const char *name, *path;
    enum { ANTIPODE, EAST, EAST_AND_WEST } goal;
    const char *sets[4];
    size_t set_count;
};

double cpu() {
    timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}
[[noreturn]] void fail(const char *what) {
    fprintf(stderr, "detour: %s\n", what);
    exit(1);
}

/* ---- Jostle ---- */

JoScene *load(const Scene &scene) {
    JoSceneDef def = jo_default_scene_def();
    def.path = scene.path;
    def.overrides = scene.sets;
    def.override_count = scene.set_count;
    def.threads = 1;
    JoError error = {};
    JoScene *loaded = jo_scene_load(&def, &error);
    if (!loaded)
        fail(error.text);
    return loaded;
}

/* Who stands where as the scene begins. Those of the first group, which have the lower ids, walk
   east, the others west. */
std::vector<Person> people_of(const Scene &scene) {
    JoScene *loaded = load(scene);
    JoWorld *world = jo_scene_world(loaded);
    std::vector<JoAgent> agents(jo_world_agent_count(world));
    jo_world_agents(world, agents.data(), uint32_t(agents.size()));
    std::vector<Person> people;
    for (size_t i = 0; i < agents.size(); i++) {
        const JoAgentState s = jo_agent_state(world, agents[i]);
        const float x = float(s.x), y = float(s.y);
        // What both behaviours give everybody, and what Jostle allows them.
        Person p = {x, y, float(s.radius), 1.3f, 1.8f, -x, -y};
        if (scene.goal != Scene::ANTIPODE) {
            const bool west = scene.goal == Scene::EAST_AND_WEST && i >= agents.size() / 2;
            p.goal_x = x + (west ? -1000.0f : 1000.0f);
            p.goal_y = y;
        }
        people.push_back(p);
    }
    jo_scene_free(loaded);
    return people;
}

double time_jostle(const Scene &scene) {
    JoScene *loaded = load(scene);
    JoError error = {};
    for (int i = 0; i < WARM_UP; i++)
        if (!jo_scene_step(loaded, &error))
            fail(error.text);
    const JoStats from = jo_scene_stats(loaded);
    for (int i = 0; i < STEPS; i++)
        if (!jo_scene_step(loaded, &error))
            fail(error.text);
    const JoStats to = jo_scene_stats(loaded);
    jo_scene_free(loaded);
    return (to.cpu_s - from.cpu_s) * 1e9 / double(to.agent_steps - from.agent_steps);
}

/* ---- DetourCrowd: x east, z north, y up ---- */

dtNavMesh *make_plain() {
    const float cell = 0.1f; // m, of the whole numbers in which vertices are given
    const unsigned short far = static_cast<unsigned short>(2.0f * HALF / cell);
    const unsigned short vertices[] = {0, 0, 0, 0, 0, far, far, 0, far, far, 0, 0};
    const unsigned short polygon[] = {0, 1, 2, 3, 0xffff, 0xffff, 0xffff, 0xffff};
    const unsigned short flags[] = {1};
    const unsigned char areas[] = {0};
    dtNavMeshCreateParams params = {};
    params.verts = vertices;
    params.vertCount = 4;
    params.polys = polygon;
    params.polyFlags = flags;
    params.polyAreas = areas;
    params.polyCount = 1;
    params.nvp = 4;
    params.walkableHeight = HEIGHT;
    params.walkableRadius = 0.2f;
    params.walkableClimb = 0.5f;
    params.bmin[0] = params.bmin[2] = -HALF;
    params.bmax[0] = params.bmax[2] = HALF;
    params.bmax[1] = 2.0f;
    params.cs = params.ch = cell;
    params.buildBvTree = true;
    unsigned char *data = nullptr;
    int size = 0;
    dtNavMesh *mesh = dtAllocNavMesh();
    if (!dtCreateNavMeshData(&params, &data, &size) ||
        dtStatusFailed(mesh->init(data, size, DT_TILE_FREE_DATA)))
        fail("DetourCrowd's plain could not be made");
    return mesh;
}

dtCrowd *make_crowd(dtNavMesh *mesh, const std::vector<Person> &people) {
    dtCrowd *crowd = dtAllocCrowd();
    if (!crowd->init(int(people.size()), 0.6f, mesh))
        fail("DetourCrowd could not be made");
    for (const Person &p : people) {
        dtCrowdAgentParams params = {};
        params.radius = p.radius;
        params.height = HEIGHT;
        params.maxAcceleration = 26.0f; // its velocity may change by 1.3 m/s within a step
        params.maxSpeed = p.max_speed;
        params.collisionQueryRange = 5.0f; // perception, as both behaviours have it
        params.pathOptimizationRange = 5.0f;
        params.updateFlags = DT_CROWD_OBSTACLE_AVOIDANCE;
        params.obstacleAvoidanceType = 0;
        const float at[3] = {p.x, 0.0f, p.y};
        if (crowd->addAgent(at, &params) < 0)
            fail("DetourCrowd takes no more people");
    }
    return crowd;
}

/* The wanted velocities of a step. */
void steer(dtCrowd *crowd, const std::vector<Person> &people) {
    for (size_t i = 0; i < people.size(); i++) {
        const dtCrowdAgent *agent = crowd->getAgent(int(i));
        const Person &p = people[i];
        const float x = p.goal_x - agent->npos[0], y = p.goal_y - agent->npos[2];
        const float far = std::hypot(x, y), speed = far > 0.1f ? p.speed / far : 0.0f;
        const float velocity[3] = {x * speed, 0.0f, y * speed};
        crowd->requestMoveVelocity(int(i), velocity);
    }
}

/* How far people came on the way to their goals, m: a crowd that stands costs nothing. */
double progress(dtCrowd *crowd, const std::vector<Person> &people) {
    double sum = 0.0;
    for (size_t i = 0; i < people.size(); i++) {
        const float *at = crowd->getAgent(int(i))->npos;
        const Person &p = people[i];
        sum += std::hypot(p.goal_x - p.x, p.goal_y - p.y) -
               std::hypot(p.goal_x - at[0], p.goal_y - at[2]);
    }
    return sum / double(people.size());
}

double time_detour(dtNavMesh *mesh, const std::vector<Person> &people, double *came) {
    dtCrowd *crowd = make_crowd(mesh, people);
    double spent = 0.0;
    for (int step = 0; step < WARM_UP + STEPS; step++) {
        steer(crowd, people);
        const double begin = cpu();
        crowd->update(0.05f, nullptr);
        if (step >= WARM_UP)
            spent += cpu() - begin;
    }
    *came = progress(crowd, people);
    dtFreeCrowd(crowd);
    return spent * 1e9 / (double(STEPS) * double(people.size()));
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

} // namespace

int main() {
    const Scene scenes[] = {
        {"circle", "scenes/circle.yaml", Scene::ANTIPODE, {}, 0},
        {"one-way-3", "scenes/one-way.yaml", Scene::EAST, {}, 0},
        {"counterflow-3",
         "scenes/counterflow.yaml",
         Scene::EAST_AND_WEST,
         {"groups.eastward.count=2450", "groups.westward.count=2450", "groups.eastward.spacing=0.8",
          "groups.westward.spacing=0.8"},
         4},
        {"counterflow-6", "scenes/counterflow.yaml", Scene::EAST_AND_WEST, {}, 0},
    };
    dtNavMesh *mesh = make_plain();
    printf("ns of processor time per agent and step, one thread, median of %d rounds\n", ROUNDS);
    printf("%-16s %7s %9s %12s %7s   %s\n", "scene", "agents", "Jostle", "DetourCrowd", "ratio",
           "its people came");
    for (const Scene &scene : scenes) {
        const std::vector<Person> people = people_of(scene);
        std::vector<double> ours, theirs;
        double came = 0.0;
        for (int round = 0; round < ROUNDS; round++) {
            ours.push_back(time_jostle(scene));
            theirs.push_back(time_detour(mesh, people, &came));
        }
        printf("%-16s %7zu %9.1f %12.1f %7.2f   %.2f m\n", scene.name, people.size(), median(ours),
               median(theirs), median(theirs) / median(ours), came);
        fflush(stdout);
    }
    dtFreeNavMesh(mesh);
    return 0;
}
