// Tests of the figures without a browser: skeleton, poses, meshes, steps and levels of detail. Prints what is wrong, so
// nothing where all is well; `make check` runs it.
import { makeBody, PIECE } from "../../core/view/page/draw/figure/body.js";
import { Levels } from "../../core/view/page/draw/figure/levels.js";
import { Motion, STRIDE } from "../../core/view/page/draw/figure/motion.js";
import { Piles, STEP } from "../../core/view/page/draw/figure/piles.js";
import { ACTIONS, ankleAt, bakePoses, cyclesPerMetre, FRAMES, GAIT_COUNT, gaitOf, GAITS, mirrorPose, poseOf, ROWS } from "../../core/view/page/draw/figure/poses.js";
import { BONE, BONES, BREADTH, DEPTH, turn } from "../../core/view/page/draw/figure/skeleton.js";
import { skinMesh } from "../../core/view/page/draw/figure/skin.js";

const distance = (a, b) => Math.hypot(...a.map((v, k) => v - b[k]));
const expect = (holds, text) => holds || console.log(text);

/** Reads the bits of a half float. */
function fromHalf(bits) {
    const exponent = (bits >> 10) & 31, part = bits & 1023, sign = bits & 0x8000 ? -1 : 1;
    return sign * (exponent === 0 ? part * 2 ** -24 : (1 + part / 1024) * 2 ** (exponent - 15));
}

function limbsKeepTheirLengths() {
    for (let row = 0; row < ROWS; row++) {
        for (let f = 0; f < FRAMES; f++) {
            const { joints } = poseOf(row, f);
            BONES.forEach((bone, i) => {
                if (bone.parent < 0) return;
                const long = distance(joints[i], joints[bone.parent]), model = distance(bone.at, BONES[bone.parent].at);
                expect(Math.abs(long - model) < 1e-6, `${bone.name} is ${long} m from its parent in row ${row}, frame ${f}, in the model ${model} m`);
            });
        }
    }
}

function stepsAreSymmetrical() {
    for (let row = 0; row < GAIT_COUNT; row++) {
        for (let f = 0; f < FRAMES; f++) {
            const other = mirrorPose(poseOf(row, (f + FRAMES / 2) % FRAMES)).joints;
            const off = Math.max(...poseOf(row, f).joints.map((joint, i) => distance(joint, other[i])));
            expect(off < 1e-6, `the steps of gait ${row} differ by ${off} m between left and right in frame ${f}`);
        }
    }
}

/** The part of a left sole that is on the floor (heel or ball), of a pose: how far ahead of the body, m. */
function soleOf({ turns, joints }) {
    const foot = BONE.footLeft, spots = [-0.06, 0.12].map((x) => turn(turns[foot], [x, 0, -0.08]).map((v, k) => v + joints[foot][k]));
    return spots.map(([x, , z]) => ({ x, z }));
}

/** Poses between two gaits as the graphics card makes them, from the texture. */
function blend(texture, gait, f) {
    const row = Math.floor(gait), t = gait - row, { data, width } = texture, block = BONES.length * ROWS;
    const read = (bone, r, joint) => [0, 1, 2, 3].map((k) => fromHalf(data[4 * (((joint ? block : 0) + bone * ROWS + r) * width + f) + k]));
    const mixed = (bone, joint) => read(bone, row, joint).map((v, k) => v + t * ((t > 0 ? read(bone, row + 1, joint)[k] : v) - v));
    return { turns: BONES.map((_, bone) => { const q = mixed(bone, false), size = Math.hypot(...q); return q.map((v) => v / size); }), joints: BONES.map((_, bone) => mixed(bone, true).slice(0, 3)) };
}

function feetStay() {
    const texture = bakePoses();
    for (const speed of [0.35, 0.6, 0.8, 1.1, 1.35, 1.6, 1.9, 2.6, 4]) {
        const gait = gaitOf(speed), long = 1 / cyclesPerMetre(gait), floor = GAITS[Math.round(gait)].floor;
        let most = 0;
        for (let f = 0; f + 1 < floor * FRAMES - 1; f++) {
            const [a, b] = [f, f + 1].map((frame) => soleOf(blend(texture, gait, frame)));
            const on = [0, 1].reduce((best, k) => (a[k].z + b[k].z < a[best].z + b[best].z ? k : best), 0); // the lower one
            most = Math.max(most, Math.abs(b[on].x - a[on].x + long / FRAMES));
        }
        expect(most < 0.3 * (long / FRAMES) + 0.004, `at ${speed} m/s a foot on the floor slides by ${(1000 * most).toFixed(1)} mm between frames, of ${(1000 * long / FRAMES).toFixed(1)} mm walked`);
    }
    for (let row = 0; row < GAIT_COUNT; row++) {
        const low = Math.min(...Array.from({ length: FRAMES }, (_, f) => Math.min(...soleOf(poseOf(row, f)).map(({ z }) => z))));
        expect(low > -0.006, `feet of gait ${row} are ${low} m under the floor`);
    }
    expect(Math.abs(ankleAt(GAITS[3], 0.3).z - 0.08) < 1e-9, "a flat foot is not on the floor");
}

function texturesAgree() {
    const texture = bakePoses();
    expect(texture.data.length === 4 * texture.width * texture.height && texture.width === FRAMES, "the texture of poses has another size");
    for (let row = 0; row < GAIT_COUNT; row++) {
        const off = Math.max(...poseOf(row, 5).joints.map((joint, i) => distance(joint, blend(texture, row, 5).joints[i])));
        expect(off < 1e-3, `half floats move a joint of gait ${row} by ${off} m`);
    }
}

function meshesFit() {
    const most = [2700, 1250, 570];
    most.forEach((limit, level) => {
        const body = makeBody(level), stands = skinMesh(body, poseOf(0, 0));
        expect(body.index.length / 3 <= limit, `level ${level} has ${body.index.length / 3} triangles`);
        expect([...body.position, ...body.normal].every(Number.isFinite), `level ${level} has holes`);
        let [wide, deep, high, low] = [0, 0, 0, 1];
        body.piece.forEach((piece, i) => {
            const [x, y, z] = stands.position.subarray(3 * i, 3 * i + 3);
            if (piece !== PIECE.body) return;
            wide = Math.max(wide, Math.abs(y));
            if (z > 1 && z < 1.48 && body.bone[4 * i] <= BONE.chest) deep = Math.max(deep, Math.abs(x));
            high = Math.max(high, z);
            low = Math.min(low, z);
        });
        expect(Math.abs(2 * wide - BREADTH) < 0.05 && Math.abs(2 * deep - DEPTH) < 0.04, `level ${level} is ${2 * wide} m broad and ${2 * deep} m deep`);
        expect(Math.abs(high - 1.75) < 0.02 && Math.abs(low) < 0.02, `level ${level} stands from ${low} to ${high} m`);
    });
}

/** A frame of one person at x, y (m) who looks along heading, 256ths of a turn. */
function frameOf(time, x, y, heading = 0) {
    const bytes = new Uint8Array(8), words = new Uint16Array(bytes.buffer);
    words[0] = Math.round((x + 10) * 1000);
    words[1] = Math.round((y + 10) * 1000);
    bytes[4] = heading;
    return { time, slots: 1, x0: -10, y0: -10, sx: 0.001, sy: 0.001, bytes, words, chests: null };
}

function phasesFollowTheWay() {
    for (const [name, heading, sign] of [["ahead", 0, 1], ["backwards", 128, -1], ["sideways", 60, 1]]) {
        const motion = new Motion();
        motion.grow(1);
        let before = frameOf(0, 0, 0, heading), turns = 0, last = motion.phase[0];
        for (let k = 1; k <= 60; k++) {
            const next = frameOf(k / 20, (k / 20) * 1.35, 0, heading);
            motion.take(before, next, false);
            if (k > 30) turns += (((motion.phase[0] - last) % 1) + 1.5) % 1 - 0.5;
            last = motion.phase[0];
            before = next;
        }
        const expected = (sign * 1.5 * 1.35) * cyclesPerMetre(gaitOf(1.35));
        expect(Math.abs(turns - expected) < 0.05, `who walks ${name} makes ${turns} cycles, not ${expected}`);
        const jumped = motion.phase[0];
        motion.take(before, frameOf(9, 5, 5), true);
        expect(motion.phase[0] === jumped, "a jump moves the feet");
        expect(motion.bytes.length === STRIDE, "a slot has other bytes");
    }
}

function whoFallsOverOthersLiesOnThem() {
    const piles = new Piles(), heights = (slots, places) => [...piles.stack(slots, places.flat())].map((height) => height * STEP);
    const here = [0, 0, 0], across = [0.2, 0.3, 64], apart = [5, 0, 0];
    const same = (got, wanted, text) => expect(got.every((height, i) => Math.abs(height - wanted[i]) < 0.011), `${text}: heights are ${got} m`);
    same(heights([7], [here]), [0], "one lies on the floor");
    same(heights([3, 7], [across, here]), [0.18, 0], "who fell later lies above");
    same(heights([3, 5, 7], [across, apart, here]), [0.18, 0, 0], "who lies apart is on the floor");
    same(heights([3, 5, 7, 9], [across, apart, here, [0, 0.1, 200]]), [0.18, 0, 0, 0.36], "a third one is above both");
    same(heights([3, 5, 9], [across, apart, [0, 0.1, 200]]), [0, 0, 0.18], "when the lowest rises, the others sink");
    const many = Array.from({ length: 40 }, (_, i) => i);
    expect(Math.max(...heights(many, many.map(() => here))) < 0.7, "a pile is higher than 0.7 m");
}

function everybodyIsDrawn() {
    const slots = 3000, bytes = new Uint8Array(8 * slots), words = new Uint16Array(bytes.buffer);
    for (let s = 0; s < slots; s++) {
        words[4 * s] = (s * 7919) % 65536;
        words[4 * s + 1] = (s * 104729) % 65536;
    }
    const frame = { slots, x0: -50, y0: -50, sx: 100 / 65535, sy: 100 / 65535, bytes, words };
    const levels = new Levels([150, 84, 40], [20, 100, 500]), all = [1e-3, 0, 0, 0, 0, 1e-3, 0, 0, 0, 0, 1e-3, 0, 0, 0, 0, 1];
    levels.grow(slots);
    levels.choose(frame, all, { x: 0, y: 0, z: 1.7 }, 2000, false);
    const drawn = new Set();
    for (let list = 0; list < 4; list++) for (let k = 0; k < levels.counts[list]; k++) drawn.add(levels.lists[list][k]);
    expect(drawn.size === slots, `${drawn.size} of ${slots} people are drawn`);
    [20, 100, 500].forEach((most, k) => expect(levels.counts[k] > 0 && levels.counts[k] <= 1.5 * most + 8, `${levels.counts[k]} people in level ${k}, of at most ${most}`));
}

expect(ACTIONS.length - 1 + GAIT_COUNT === ROWS, "rows of poses are missing");
for (const test of [limbsKeepTheirLengths, stepsAreSymmetrical, feetStay, texturesAgree, meshesFit, phasesFollowTheWay, whoFallsOverOthersLiesOnThem, everybodyIsDrawn]) test();
