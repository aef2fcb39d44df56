// The camera of a game: low behind the player's side, towards the others, moving along with the player.

const BACK = 9, RISE = 6, AHEAD = 4; // m: behind the player, above the floor, and the point before them that it looks at
const EASE = 0.25; // s: time constant of its motion
const SNAP = Math.PI / 4; // rad: directions that it may look in

export class PlayCamera {
    constructor(view) {
        this.view = view;
        this.way = null; // unit vector from the player's side to the others
    }

    /** Forgets the direction: the next picture finds it from where all stand. */
    begin() {
        this.way = null;
    }

    /** Looks from the player at [x, y] to the middle of the others. */
    find(at, others) {
        if (others.length === 0) return;
        const mean = others.reduce((sum, p) => [sum[0] + p[0] / others.length, sum[1] + p[1] / others.length], [0, 0]);
        const turn = Math.round(Math.atan2(mean[1] - at[1], mean[0] - at[0]) / SNAP) * SNAP;
        this.way = [Math.cos(turn), Math.sin(turn)];
        this.time = undefined;
    }

    /** Moves with the player, who is at [x, y] on a floor at height `floor`, m, at `time` (ms). `others`: [x, y] of the other people. */
    keepUp(at, floor, others, time) {
        const { view } = this;
        if (!this.way) this.find(at, others());
        if (!this.way || view.top) return;
        const share = this.time === undefined ? 1 : 1 - Math.exp(-Math.max(0, time - this.time) / 1000 / EASE);
        const [x, y] = this.way, { perspective, orbit } = view;
        const glide = (vector, to) => ["x", "y", "z"].forEach((k, i) => (vector[k] += share * (to[i] - vector[k])));
        this.time = time;
        glide(orbit.target, [at[0] + AHEAD * x, at[1] + AHEAD * y, floor + 0.5]);
        glide(perspective.position, [at[0] - BACK * x, at[1] - BACK * y, floor + RISE]);
        view.handled = true; // the picture's size does not move it home
        orbit.update();
        view.dirty = true;
    }
}
