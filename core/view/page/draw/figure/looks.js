// GLSL of clothes: which pieces a person wears, and the colour of each part of them. The top carries the colour of
// the state or value; the rest differs between people, less where colours are values.
import { PART, PIECE } from "./body.js";

/** Kinds of clothes by number, as a group of a scene names them. */
export const CLOTHES = ["casual", "ihram", "sport", "work"];

export const LOOKS = `
struct Outfit {
    vec3 top, sleeve, hips, leg, skin, hair, shoe, bag;
    bool veil, longHair, hat, bagged, skirt, robe;
};

vec3 pick(float k, vec3 a, vec3 b, vec3 c, vec3 d, vec3 e) {
    return k < 0.2 ? a : k < 0.4 ? b : k < 0.6 ? c : k < 0.8 ? d : e;
}
vec3 skinOf(float k) {
    vec3 dark = vec3(0.35, 0.22, 0.16), middle = vec3(0.68, 0.48, 0.35), pale = vec3(0.94, 0.77, 0.65);
    return k < 0.4 ? mix(dark, middle, k / 0.4) : mix(middle, pale, (k - 0.4) / 0.6);
}
vec3 hairOf(float k) {
    return k < 0.55 ? mix(vec3(0.06, 0.055, 0.06), vec3(0.16, 0.1, 0.07), k / 0.55) : k < 0.85 ? mix(vec3(0.24, 0.15, 0.09), vec3(0.45, 0.31, 0.18), (k - 0.55) / 0.3)
        : k < 0.93 ? vec3(0.72, 0.56, 0.33) : vec3(0.62, 0.61, 0.6);
}

/* classes: as in the records; 0: colours are values, and nothing else is to be read as one. */
Outfit dress(uint look, uint clothes, vec3 colour, bool plays, float classes) {
    Outfit o;
    float light = chance(look, 2u), kind = chance(look, 3u), head = chance(look, 4u), legs = chance(look, 5u);
    bool values = classes < 0.5, woman = kind < 0.5;
    o.skin = skinOf(chance(look, 6u));
    o.hair = hairOf(chance(look, 7u));
    o.top = colour * (values ? 0.97 + 0.06 * light : 0.82 + 0.3 * light);
    if (!values) o.top = mix(o.top, vec3(dot(o.top, vec3(0.33))) , 0.12 * chance(look, 11u));
    vec3 cloth = pick(legs, vec3(0.16, 0.19, 0.28), vec3(0.25, 0.26, 0.28), vec3(0.47, 0.42, 0.34), vec3(0.12, 0.12, 0.14), vec3(0.32, 0.36, 0.42));
    o.hips = values ? mix(colour * 0.72, cloth, 0.25) : mix(cloth, colour * 0.6, 0.18);
    o.leg = o.hips;
    o.sleeve = chance(look, 8u) < 0.55 ? o.skin : o.top;
    o.shoe = chance(look, 9u) < 0.3 ? vec3(0.75, 0.74, 0.72) : vec3(0.14, 0.12, 0.12);
    o.bag = pick(chance(look, 10u), vec3(0.16, 0.17, 0.2), vec3(0.35, 0.22, 0.15), vec3(0.2, 0.27, 0.22), vec3(0.45, 0.2, 0.18), vec3(0.28, 0.28, 0.3));
    o.veil = woman && head < 0.16;
    o.longHair = woman && !o.veil && head < 0.8;
    o.hat = !woman && head < 0.16;
    o.bagged = chance(look, 12u) < 0.16;
    o.robe = o.veil && legs < 0.7;
    o.skirt = woman && !o.veil && legs > 0.72;
    if (o.veil) {
        o.sleeve = o.top;
        o.hair = mix(colour * 0.75, pick(chance(look, 13u), vec3(0.1), vec3(0.75, 0.72, 0.66), vec3(0.45, 0.5, 0.58), vec3(0.55, 0.4, 0.38), vec3(0.2, 0.22, 0.3)), 0.7);
    }
    if (clothes == 1u) { // two white cloths; women are covered, in white or in dark
        o.bagged = o.hat = o.longHair = o.skirt = false;
        vec3 white = vec3(0.93, 0.92, 0.89) * (0.95 + 0.05 * light), cover = legs < 0.45 ? white : vec3(0.13, 0.13, 0.15);
        o.veil = o.robe = woman;
        if (!woman) {
            o.robe = true;
            o.top = mix(white, colour, values ? 0.95 : 0.5);
            o.hips = o.leg = mix(white, colour, values ? 0.6 : 0.08);
            o.sleeve = o.skin;
            if (head < 0.35) o.hair = o.skin * 0.8; // shaven
        } else {
            o.top = mix(cover, colour, values ? 0.95 : 0.6);
            o.hips = o.leg = mix(cover, colour, values ? 0.6 : 0.12);
            o.sleeve = o.top;
            o.hair = mix(cover, colour, values ? 0.6 : 0.0);
        }
        o.shoe = o.skin * 0.8;
    } else if (clothes == 2u) { // shirt and shorts
        o.veil = o.robe = o.skirt = o.bagged = o.hat = false;
        o.sleeve = o.skin;
        o.hips = mix(colour * 0.45, vec3(0.1, 0.1, 0.13), 0.4);
        o.leg = o.skin;
        o.shoe = vec3(0.85);
    } else if (clothes == 3u) { // overalls and a helmet
        o.veil = o.robe = o.skirt = o.longHair = o.bagged = false;
        o.hat = true;
        o.bag = vec3(0.93, 0.75, 0.12);
        o.hips = o.leg = mix(vec3(0.2, 0.24, 0.32), colour * 0.6, 0.2);
        o.sleeve = o.top;
    }
    if (plays) o.hips = o.leg = vec3(0.96);
    return o;
}

/* Whether a person wears a piece, and a part is in sight. */
bool wears(Outfit o, uint piece, uint part) {
    if (o.robe && part == ${PART.leg}u) return false;
    return piece == ${PIECE.body}u || (piece == ${PIECE.cover}u && (o.veil || o.longHair)) || (piece == ${PIECE.hat}u && o.hat)
        || (piece == ${PIECE.bag}u && o.bagged) || (piece == ${PIECE.skirt}u && (o.skirt || o.robe));
}

/* The colour of a part. */
vec3 paintOf(Outfit o, uint part) {
    return part == ${PART.top}u ? o.top : part == ${PART.sleeve}u ? o.sleeve : part == ${PART.hips}u || part == ${PART.skirt}u ? o.hips
        : part == ${PART.leg}u ? (o.skirt ? o.skin : o.leg) : part == ${PART.skin}u || part == ${PART.head}u ? o.skin : part == ${PART.cover}u ? o.hair
        : part == ${PART.shoe}u ? o.shoe : o.bag;
}
`;

/** GLSL of a point of the body, by its place in the pose of the model. */
export const SURFACE = `
/* Whether a point of the head, in the pose of the model, has hair. */
bool hairy(vec3 at) { return at.z > 1.703 - 0.075 * smoothstep(0.085, 0.0, at.x) - 0.1 * smoothstep(0.02, -0.07, at.x); }

/* The eyes: how dark a point of the head is. */
float eyeAt(vec3 at) {
    vec2 off = (vec2(abs(at.y) - 0.03, at.z - 1.643)) / vec2(0.0085, 0.0062);
    return at.x > 0.05 ? 1.0 - smoothstep(0.8, 1.2, length(off)) : 0.0;
}

/* The share of the sky that a point of the body sees, by its place in the pose of the model. */
float openOf(vec3 at, uint part) {
    float open = 0.66 + 0.34 * smoothstep(0.0, 0.9, at.z);
    if (part == ${PART.leg}u || part == ${PART.hips}u) open *= 0.72 + 0.28 * smoothstep(0.02, 0.1, abs(at.y));
    if (part == ${PART.top}u) open *= 1.0 - 0.14 * smoothstep(0.2, 0.13, abs(at.y) + 1.2 * abs(at.x)) * smoothstep(1.48, 1.36, at.z);
    if (part == ${PART.skin}u && at.z > 1.45) open *= 0.72;
    if (part == ${PART.head}u) open *= 0.84 + 0.16 * smoothstep(1.53, 1.6, at.z);
    return open;
}
`;
