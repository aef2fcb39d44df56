/* A world made by hand, with bodies of one's own: a cart that is pushed along, a crate that is
   thrown at somebody, and a door that is moved by the program. */
#include <math.h>
#include <stdio.h>

#include <jostle.h>

int main(void) {
    JoError error = {0};
    JoWorldDef def = jo_default_world_def();
    JoWorld *world = jo_world_create(&def, &error);
    JoBodyDef cart = jo_default_body_def();
    cart.size[0] = 1.2;
    cart.size[1] = 0.8;
    cart.mass = 40;
    cart.friction = 0.05;
    cart.x = 3;
    const JoBody wagon = jo_world_add_body(world, &cart, &error);
    JoBodyDef box = jo_default_body_def();
    box.size[0] = box.size[1] = box.size[2] = 0.3;
    box.mass = 5;
    box.x = -6;
    box.z = 1.2;
    const JoBody crate = jo_world_add_body(world, &box, &error);
    JoBodyDef slab = jo_default_body_def();
    slab.size[0] = 0.2;
    slab.size[1] = 4;
    slab.size[2] = 2;
    slab.mass = 0; /* static: only the program moves it */
    slab.x = 6;
    slab.z = 1;
    const JoBody door = jo_world_add_body(world, &slab, &error);
    if (!door.generation) {
        fprintf(stderr, "%s\n", error.text);
        return 1;
    }
    JoAgentDef person = jo_default_agent_def();
    const JoAgent one = jo_world_add_agent(world, &person, &error);
    jo_agent_set_preferred(world, one, 1.2, 0);

    uint32_t hits = 0;
    double stopped_at = 0;
    for (int step = 0; step < 240; step++) {
        if (step == 0 || step == 150) /* the cart is set going: 80 N s on 40 kg */
            jo_body_impulse(world, wagon, (double[]){80, 0, 0}, NULL, &error);
        if (step == 20) { /* thrown from behind, at chest height */
            const JoAgentState at = jo_agent_state(world, one);
            jo_body_place(world, crate, (double[]){at.x - 2, at.y, 1.2}, NULL, &error);
            jo_body_set_velocity(world, crate, (double[]){9, 0, 1}, NULL, &error);
        }
        if (step == 140) { /* the door goes aside */
            stopped_at = jo_body_state(world, wagon).x;
            jo_body_place(world, door, (double[]){6, 5, 1}, NULL, &error);
        }
        jo_world_step(world, 1);
        const JoEvents events = jo_world_events(world);
        hits += events.hit_count;
    }
    const JoCast ahead = jo_world_cast(world, (double[]){-10, 0}, (double[]){40, 0}, 0.1,
                                       JO_CAST_BODIES | JO_CAST_AGENTS);
    const double end = jo_body_state(world, wagon).x;
    printf(
        "%u hits; the cart stood at %.2f m, then went to %.2f m; a disc meets kind %d at %.2f m\n",
        hits, stopped_at, end, (int)ahead.kind, ahead.x);
    const int good = hits > 0 && stopped_at < 5.5 && end > stopped_at + 0.5 && ahead.hit;
    jo_world_free(world);
    return good ? 0 : 1;
}
