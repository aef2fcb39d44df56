// Shaders of scenery. It stands still, or is carried by a body, whose pose it takes from the texture of bodies.
import { LOWERED } from "./ground_shaders.js";
import { LIGHT } from "./light.js";
import { POSE } from "./pose_shaders.js";

/** Blocks that stand between the eye and the box `keep` are lowered like walls; roofs are left out below the eye. */
export const SCENERY_VERTEX = `
precision highp float;
` + POSE + `
attribute vec3 position;
attribute vec3 normal;
attribute vec4 ink;        // colour, and glow
attribute vec4 where;      // middle of the block, and from there to beside it, m
attribute vec3 part;       // height of the shape's foot; height above which no eye sees it, 0: none; row of its body, -1: none
uniform vec3 eye;
uniform vec4 keep;         // x0, y0, x1, y1
uniform float lowered, edge;
uniform mat4 modelMatrix, viewMatrix, projectionMatrix;
varying vec3 facing;
varying vec4 colour;
varying vec3 at;
void main() {
    at = position;
    facing = normal;
    colour = ink;
    vec4 placed;
    bool gone = part.y > 0.0 && eye.z > (modelMatrix * vec4(0.0, 0.0, part.y, 1.0)).z;
    if (part.z > -0.5) {
        vec4 q;
        vec3 middle = poseOf(part.z, q);
        // It stands on the floor under its body, turned about the vertical axis as the body is.
        vec3 along = turned(vec3(1.0, 0.0, 0.0), q);
        vec2 a = length(along.xy) > 1e-3 ? normalize(along.xy) : vec2(1.0, 0.0), b = vec2(-a.y, a.x);
        at = vec3(middle.xy + a * position.x + b * position.y, position.z);
        facing = vec3(a * normal.x + b * normal.y, normal.z);
        gone = gone || middle.z < -500.0;
        placed = vec4(at.xy, at.z + floorUnder(part.z), 1.0);
    } else {
        vec2 behind = where.xy + (dot(where.zw, where.xy - eye.xy) < 0.0 ? -where.zw : where.zw);
        bool hides = all(greaterThan(behind, keep.xy + edge)) && all(lessThan(behind, keep.zw - edge));
        if (hides && lowered > 0.5) {
            at.z = min(at.z, ${LOWERED});
            gone = gone || part.x >= ${LOWERED};
        }
        placed = modelMatrix * vec4(at, 1.0);
    }
    gl_Position = projectionMatrix * viewMatrix * placed;
    if (gone) gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
}`;

export const SCENERY_FRAGMENT = `
precision highp float;
` + LIGHT + `
uniform vec3 sky;
uniform vec3 extent;
uniform float dim;
varying vec3 facing;
varying vec4 colour;
varying vec3 at;
void main() {
    vec3 n = normalize(gl_FrontFacing ? facing : -facing);
    float open = 0.75 + 0.25 * smoothstep(0.0, 1.0, at.z);
    vec3 own = mix(lit(colour.rgb, n, open) * mix(1.0, dim, 0.8), colour.rgb, colour.a);
    float far = distance(at.xy, extent.xy) / extent.z;
    gl_FragColor = vec4(mix(own, sky, 0.75 * smoothstep(1.2, 3.4, far)), 1.0);
}`;
