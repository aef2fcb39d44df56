// A program with a Bullet world of its own: people push its box, as far as they push Jostle's own box in the same
// situation, and a box of its that slides pushes people.
#include <cmath>
#include <cstdio>
#include <jostle_bullet.hpp>
#include <memory>

namespace {

constexpr double DT = 0.05;
constexpr float SIDE = 1, MASS = 60, FRICTION = 0.3F;

// Gravity, a ground, and boxes.
class Own {
  public:
    Own() {
        bullet_.setGravity(btVector3(0, 0, -9.81F));
        add(ground_, 0, btVector3(0, 0, 0));
    }
    ~Own() {
        for (const auto &body : bodies_)
            bullet_.removeRigidBody(body.get());
    }
    btRigidBody &add_box(const btVector3 &at) { return add(box_, MASS, at); }
    void step() { bullet_.stepSimulation(static_cast<btScalar>(DT), 20, 1.0F / 240); }

  private:
    btRigidBody &add(btCollisionShape &shape, btScalar mass, const btVector3 &at) {
        btVector3 inertia(0, 0, 0);
        if (mass > 0)
            shape.calculateLocalInertia(mass, inertia);
        btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, &shape, inertia);
        info.m_friction = mass > 0 ? FRICTION : 1;
        info.m_startWorldTransform.setOrigin(at);
        bodies_.push_back(std::make_unique<btRigidBody>(info));
        bullet_.addRigidBody(bodies_.back().get());
        return *bodies_.back();
    }
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_{&configuration_};
    btDbvtBroadphase broadphase_;
    btSequentialImpulseConstraintSolver solver_;
    btDiscreteDynamicsWorld bullet_{&dispatcher_, &broadphase_, &solver_, &configuration_};
    btStaticPlaneShape ground_{btVector3(0, 0, 1), 0};
    btBoxShape box_{btVector3(SIDE / 2, SIDE / 2, SIDE / 2)};
    std::vector<std::unique_ptr<btRigidBody>> bodies_;
};

// Six who press towards +x in a corridor, in two rows behind x = -0.8 m.
std::unique_ptr<jostle::World> crowd() {
    auto world = std::make_unique<jostle::World>();
    for (const double y : {-0.72, 0.72}) {
        const double wall[] = {-4, y, 12, y};
        jo_world_add_line(world->get(), wall, 2, nullptr);
    }
    for (int k = 0; k < 6; k++) {
        JoAgentDef person = jo_default_agent_def();
        person.x = -0.8 - 0.45 * (k / 3);
        person.y = -0.42 + 0.42 * (k % 3);
        person.push = 120;
        jo_agent_set_preferred(world->get(), world->add(person), 1.2, 0);
    }
    return world;
}

struct Outcome {
    double given, momentum, way; // N s; kg m/s, the mean of all steps; m
};
constexpr int STEPS = 80;

Outcome own_body() {
    const auto world = crowd();
    JoBodyDef def = jo_default_body_def();
    def.size[0] = def.size[1] = def.size[2] = SIDE;
    def.mass = MASS;
    def.friction = FRICTION;
    def.z = SIDE / 2;
    const JoBody box = world->add(def);
    Outcome out{};
    for (int step = 0; step < STEPS; step++) {
        double impulse[3];
        world->step();
        jo_body_pushed(world->get(), box, impulse, nullptr);
        out.given += impulse[0];
        out.momentum += MASS * jo_body_state(world->get(), box).vx / STEPS;
    }
    out.way = jo_body_state(world->get(), box).x;
    return out;
}

Outcome bodies_of_a_program() {
    const auto world = crowd();
    Own own;
    btRigidBody &box = own.add_box(btVector3(0, 0, SIDE / 2));
    jostle::BulletBridge bridge(world->get());
    const JoBody like = bridge.join(box);
    Outcome out{};
    for (int step = 0; step < STEPS; step++) {
        double impulse[3];
        bridge.before();
        world->step();
        bridge.after(DT);
        jo_body_pushed(world->get(), like, impulse, nullptr);
        out.given += impulse[0];
        own.step();
        out.momentum += MASS * static_cast<double>(box.getLinearVelocity().x()) / STEPS;
    }
    out.way = box.getWorldTransform().getOrigin().x();
    return out;
}

// How far somebody is moved who stands in the way of a box that slides at 4 m/s.
double moved() {
    jostle::World world;
    Own own;
    btRigidBody &box = own.add_box(btVector3(-2, 0, SIDE / 2));
    box.setLinearVelocity(btVector3(4, 0, 0));
    const JoAgent person = world.add(jo_default_agent_def());
    jostle::BulletBridge bridge(world.get());
    bridge.join(box);
    for (int step = 0; step < 40; step++) {
        bridge.before();
        world.step();
        bridge.after(DT);
        own.step();
    }
    bridge.leave(box);
    return world.get() && jo_world_body_count(world.get()) == 0 ? jo_agent_state(world.get(), person).x : -1;
}

} // namespace

int main() {
    try {
        const Outcome own = own_body(), joined = bodies_of_a_program();
        const double away = moved();
        std::printf("own body: given %.0f N s, moves with %.1f kg m/s, by %.2f m\n", own.given, own.momentum, own.way);
        std::printf("joined:   given %.0f N s, moves with %.1f kg m/s, by %.2f m\n", joined.given, joined.momentum, joined.way);
        std::printf("somebody in the way of a box was moved by %.2f m\n", away);
        const bool alike = std::fabs(joined.given - own.given) < 0.15 * own.given &&
                           std::fabs(joined.momentum - own.momentum) < 0.15 * own.momentum &&
                           std::fabs(joined.way - own.way) < 0.15 * own.way;
        return own.momentum > 20 && alike && away > 0.3 ? 0 : 1;
    } catch (const jostle::Error &error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
