// A camera that follows a person. It stays in the user's direction as long as nothing hides the person;
// otherwise it turns and rises to a free direction. A wall or body hides the person only
// until the camera has come nearer.

import * as THREE from "three";

const NEAR = 14; // m: distance from which a person is followed
const LEAST = 1.5; // m: least distance, if something is in between
const HEAD = 1.5; // m above the floor: point that has to be visible
const MARGIN = 0.08; // share of the distance: free space around the line of sight
const TURNS = 24; // directions that are tried
const RISES = [36, 50, 64, 76, 87].map((degrees) => (degrees * Math.PI) / 180);
const STEEP = 1.2; // cost of a radian of elevation, relative to one of turn
const STAY = 0.3; // cost of a radian away from the present target
const EASE = 0.4; // s: time constant of the camera's motion
const FASTEST = 1.2; // rad/s: greatest rate of turn and rise
const HOLD = 500; // ms for which a target is kept before a better one is sought
const JUMP = 3; // m: beyond such a jump between two pictures the camera does not slide

/** Wraps an angle to -pi to pi. */
const near = (angle) => angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));

export class Follow {
    constructor(view) {
        this.view = view;
        this.now = null; // camera relative to the person: turn and rise, rad; away, m
    }

    /** Starts following from the camera's position, but at most NEAR away. */
    begin() {
        const { view } = this, away = view.camera.position.distanceTo(view.controls.target);
        if (!view.top && away > NEAR) view.turnBy(0, 0, away / NEAR);
        this.now = null;
    }

    /** Moves with the person, who is at [x, y] on a floor at height `floor`, m, at `time` (ms). */
    keepUp(at, floor, time) {
        const { view } = this, target = view.controls.target, [dx, dy, dz] = [at[0] - target.x, at[1] - target.y, floor - target.z], moved = Math.hypot(dx, dy, dz);
        if (moved > 1e-3) view.moveBy(dx, dy, dz);
        if (view.top) return;
        this.head = [at[0], at[1], floor + HEAD];
        this.heed();
        this.aim(time);
        const passed = time - (this.time ?? time);
        this.time = time;
        this.go(this.began || moved > JUMP ? Infinity : passed / 1000);
        this.began = false;
    }

    /** Takes a camera position that was not set by this as the user's wish. */
    heed() {
        const { x, y, z } = this.view.perspective.position.clone().sub(this.view.orbit.target), away = Math.hypot(x, y, z);
        const seen = { turn: Math.atan2(y, x), rise: Math.asin(z / away), away };
        this.began = !this.now;
        if (this.now && Math.hypot(x - this.put.x, y - this.put.y, z - this.put.z) < 1e-4 * away) return;
        const further = this.now ? away / Math.hypot(this.put.x, this.put.y, this.put.z) : 1;
        this.wanted = { ...seen, away: this.now ? this.wanted.away * further : away };
        this.now = { ...seen };
        this.goal = { ...this.wanted };
        this.looked = -Infinity;
    }

    place({ turn, rise, away }) {
        const t = this.view.orbit.target, flat = away * Math.cos(rise);
        return [t.x + flat * Math.cos(turn), t.y + flat * Math.sin(turn), t.z + away * Math.sin(rise)];
    }

    /** Returns whether nothing is between the person and a camera there. */
    sees(eye) {
        return !this.view.ground.between(this.head, eye) && !this.view.bodies.between(this.head, eye);
    }

    /** Returns whether a camera there, or a little beside it, sees the person. */
    free(turn, rise) {
        const { away } = this.wanted, eye = this.place({ turn, rise, away }), room = MARGIN * away;
        const across = [-Math.sin(turn) * room, Math.cos(turn) * room, 0];
        const up = [-Math.cos(turn) * Math.sin(rise) * room, -Math.sin(turn) * Math.sin(rise) * room, Math.cos(rise) * room];
        return [[0, 0], [1, 0], [-1, 0], [0, 1], [0, -1]].every(([i, j]) => this.sees(eye.map((v, k) => v + i * across[k] + j * up[k])));
    }

    /** Returns the camera's target: the user's wish, or the nearest free direction. */
    aim(time) {
        const { goal, wanted } = this;
        if (time - this.looked < HOLD && this.free(goal.turn, goal.rise)) return;
        this.looked = time;
        const best = this.free(wanted.turn, wanted.rise) ? wanted : this.search() ?? wanted;
        if (Math.hypot(near(best.turn - goal.turn), best.rise - goal.rise) < 1e-6) return;
        this.goal = { turn: this.now.turn + this.wayTo(best), rise: best.rise };
    }

    search() {
        const { wanted, goal } = this, tries = [];
        for (let i = 0; i < TURNS; i++) {
            for (const rise of [wanted.rise, ...RISES.filter((r) => r > wanted.rise)]) {
                const turn = wanted.turn + (2 * Math.PI * i) / TURNS, stay = Math.hypot(near(turn - goal.turn), rise - goal.rise);
                tries.push({ turn, rise, cost: Math.abs(near(turn - wanted.turn)) + STEEP * (rise - wanted.rise) + STAY * stay });
            }
        }
        return tries.sort((a, b) => a.cost - b.cost).find(({ turn, rise }) => this.free(turn, rise));
    }

    /** Returns the turn to a target: the shorter way round, unless more is in between there. */
    wayTo({ turn, rise }) {
        const short = near(turn - this.now.turn), long = short - Math.sign(short) * 2 * Math.PI;
        const hidden = (way) => [1, 2, 3, 4, 5].filter((i) => {
            const share = i / 6;
            return !this.free(this.now.turn + share * way, this.now.rise + share * (rise - this.now.rise));
        }).length;
        return hidden(short) > 0 && hidden(long) === 0 ? long : short;
    }

    /** Advances the camera by some seconds, and comes near enough to see the person. */
    go(seconds) {
        const { now, goal, wanted, view } = this, share = 1 - Math.exp(-seconds / EASE), most = FASTEST * seconds;
        const step = (from, to) => from + Math.max(-most, Math.min(most, share * (to - from)));
        now.turn = step(now.turn, goal.turn);
        now.rise = step(now.rise, goal.rise);
        now.away += share * (wanted.away - now.away);
        if (!this.sees(this.place(now))) now.away = this.nearer(now);
        const eye = view.perspective.position, place = new THREE.Vector3(...this.place(now));
        if (eye.distanceTo(place) > 1e-4) {
            eye.copy(place);
            view.orbit.update();
            view.moved();
        }
        this.put = eye.clone().sub(view.orbit.target);
    }

    /** Returns the greatest distance, m, from which the person is visible in a direction. */
    nearer({ turn, rise, away }) {
        let low = LEAST, high = away;
        for (let i = 0; i < 12; i++) {
            const middle = (low + high) / 2;
            if (this.sees(this.place({ turn, rise, away: middle }))) low = middle;
            else high = middle;
        }
        return low;
    }
}
