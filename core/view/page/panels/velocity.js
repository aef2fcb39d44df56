// The velocity space of one person: half-planes, the preferred velocity and the one
// that was chosen. The axes are those of the scene, in m/s.
import { fill, svg } from "../dom.js";

const SIDE = 300; // SVG units
export const PLANE_COLOURS = {
    agent: "#56b4e9", wall: "#999999", contact: "#d55e00", body: "#009e73", force: "#e69f00",
};

/** Clips a convex polygon to the side of a half-plane that is forbidden: right of its direction. */
function forbidden(polygon, [px, py], [dx, dy]) {
    const side = ([x, y]) => dx * (y - py) - dy * (x - px); // positive on the left: allowed
    const out = [];
    polygon.forEach((a, i) => {
        const b = polygon[(i + 1) % polygon.length], sa = side(a), sb = side(b);
        if (sa <= 0) out.push(a);
        if ((sa < 0 && sb > 0) || (sa > 0 && sb < 0)) {
            const t = sa / (sa - sb);
            out.push([a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]);
        }
    });
    return out;
}

/** Draws an inspected agent's planes (points and directions in m/s) into `node`. */
export function drawVelocities(node, { planes = [], preferred, chosen, max_speed: fastest }) {
    const reach = 1.15 * Math.max(0.5, fastest ?? 0, ...[preferred, chosen].filter(Boolean).map((v) => Math.hypot(...v)));
    const k = SIDE / 2 / reach;
    const at = ([x, y]) => [SIDE / 2 + k * x, SIDE / 2 - k * y];
    const square = [[-reach, -reach], [reach, -reach], [reach, reach], [-reach, reach]];
    const parts = [];
    for (const plane of planes) {
        const area = forbidden(square, plane.point, plane.direction);
        if (area.length < 3) continue;
        const colour = PLANE_COLOURS[plane.kind] ?? "#999999";
        parts.push(svg("polygon", { points: area.map((p) => at(p).join(",")).join(" "), fill: colour, "fill-opacity": 0.22, stroke: "none" }));
        const [px, py] = plane.point, [dx, dy] = plane.direction;
        const l = Math.hypot(dx, dy) || 1, far = (4 * reach) / l;
        const [x1, y1] = at([px - far * dx, py - far * dy]), [x2, y2] = at([px + far * dx, py + far * dy]);
        parts.push(svg("line", { x1, y1, x2, y2, stroke: colour, "stroke-width": 1.5 }));
    }
    const axis = [svg("line", { class: "axis", x1: 0, y1: SIDE / 2, x2: SIDE, y2: SIDE / 2 }), svg("line", { class: "axis", x1: SIDE / 2, y1: 0, x2: SIDE / 2, y2: SIDE })];
    const step = reach > 6 ? 5 : reach > 2.4 ? 1 : 0.5;
    for (let v = step; v < reach; v += step) {
        for (const s of [-v, v]) {
            const [x] = at([s, 0]), [, y] = at([0, s]);
            axis.push(svg("line", { class: "axis", x1: x, y1: SIDE / 2 - 3, x2: x, y2: SIDE / 2 + 3 }), svg("line", { class: "axis", x1: SIDE / 2 - 3, y1: y, x2: SIDE / 2 + 3, y2: y }));
        }
    }
    const [ux] = at([step, 0]);
    axis.push(svg("text", { x: ux, y: SIDE / 2 + 15, "text-anchor": "middle" }, `${step} m/s`));
    const circle = fastest > 0 ? svg("circle", { cx: SIDE / 2, cy: SIDE / 2, r: k * fastest, fill: "none", stroke: "var(--faint)", "stroke-dasharray": "5 4" }) : "";
    fill(node, svg("clipPath", { id: "inside" }, svg("rect", { width: SIDE, height: SIDE })),
        svg("g", { "clip-path": "url(#inside)" }, parts, axis, circle,
            preferred ? vector(at([0, 0]), at(preferred), "var(--faint)", "6 3") : "", chosen ? vector(at([0, 0]), at(chosen), "var(--accent)", null) : ""),
        svg("rect", { width: SIDE, height: SIDE, fill: "none", stroke: "var(--line)" }));
    node.setAttribute("viewBox", `0 0 ${SIDE} ${SIDE}`);
}

function vector([x1, y1], [x2, y2], colour, dashes) {
    return svg("g", {}, svg("line", { x1, y1, x2, y2, stroke: colour, "stroke-width": 3, "stroke-dasharray": dashes }),
        svg("circle", { cx: x2, cy: y2, r: 5, fill: colour }));
}
