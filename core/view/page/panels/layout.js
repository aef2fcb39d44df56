// Places the states of a machine in its graph: in rows by distance from the start, each
// row ordered so that few transitions cross.

const WIDE = 112, HIGH = 44, GAP = 26, ROW = 104;

/** {nodes: [{x, y}] (middles), edges: [{path, x, y}] per transition, width, height}; in SVG units. */
export function layOut(machine) {
    const names = machine.states.map((s) => s.name);
    const index = new Map(names.map((name, i) => [name, i]));
    const links = machine.transitions.map((t) => [index.get(t.from), index.get(t.to)]);
    const rank = ranks(names.length, Math.max(0, index.get(machine.start) ?? 0), links);
    const rows = [];
    rank.forEach((r, i) => (rows[r] ??= []).push(i));
    order(rows.filter(Boolean), links);
    const most = Math.max(...rows.map((row) => row?.length ?? 0));
    const width = Math.max(320, most * (WIDE + GAP) + GAP + 40);
    const nodes = [];
    rows.filter(Boolean).forEach((row, r) => row.forEach((i, k) => {
        const space = width / row.length;
        // Odd rows are shifted a little, so that straight lines pass beside the boxes between.
        nodes[i] = { x: space * (k + 0.5) + (row.length < most ? (r % 2 ? 18 : -18) : 0), y: 40 + ROW * r };
    }));
    const edges = links.map(([from, to], k) => edge(nodes, from, to, bend(links, k)));
    return { nodes, edges, width, height: 80 + ROW * (rows.filter(Boolean).length - 1) };
}

export const BOX = { wide: WIDE, high: HIGH };

function ranks(count, start, links) {
    const rank = Array(count).fill(-1);
    const queue = [start];
    rank[start] = 0;
    while (queue.length) {
        const at = queue.shift();
        for (const [from, to] of links) {
            if (from === at && to !== undefined && rank[to] < 0) {
                rank[to] = rank[at] + 1;
                queue.push(to);
            }
        }
    }
    const last = Math.max(0, ...rank) + 1; // states that nothing leads to
    return rank.map((r) => (r < 0 ? last : r));
}

/** Sorts each row by the mean place of its neighbours in the row before, a few times. */
function order(rows, links) {
    const place = new Map();
    const note = () => rows.forEach((row) => row.forEach((i, k) => place.set(i, (k + 0.5) / row.length)));
    note();
    for (let round = 0; round < 4; round++) {
        for (const row of rows) {
            const mean = new Map(row.map((i) => {
                const near = links.filter(([a, b]) => (a === i) !== (b === i)).map(([a, b]) => place.get(a === i ? b : a));
                return [i, near.length ? near.reduce((s, v) => s + v, 0) / near.length : place.get(i)];
            }));
            row.sort((a, b) => mean.get(a) - mean.get(b));
            note();
        }
    }
}

/** Bends parallel and opposite transitions away from each other. */
function bend(links, k) {
    const [from, to] = links[k];
    const same = links.slice(0, k).filter(([a, b]) => a === from && b === to).length;
    const back = links.some(([a, b]) => a === to && b === from);
    return (back ? 24 : 8) + 30 * same;
}

function edge(nodes, from, to, aside) {
    const a = nodes[from], b = nodes[to];
    if (!a || !b) return { path: "", x: 0, y: 0 };
    if (from === to) {
        const x = a.x + WIDE / 2;
        return { path: `M${x} ${a.y - 10} C${x + 34} ${a.y - 26} ${x + 34} ${a.y + 26} ${x + 2} ${a.y + 10}`, x: x + 26, y: a.y };
    }
    const dx = b.x - a.x, dy = b.y - a.y, length = Math.hypot(dx, dy) || 1;
    const far = length > 1.3 * ROW ? 0.16 * length : 0; // curve around the boxes in between
    const mx = (a.x + b.x) / 2 - (dy / length) * (aside + far), my = (a.y + b.y) / 2 + (dx / length) * (aside + far);
    const p = border(a, mx, my), q = border(b, mx, my);
    return {
        path: `M${p.x.toFixed(1)} ${p.y.toFixed(1)} Q${mx.toFixed(1)} ${my.toFixed(1)} ${q.x.toFixed(1)} ${q.y.toFixed(1)}`,
        x: 0.42 * p.x + 0.46 * mx + 0.12 * q.x, y: 0.42 * p.y + 0.46 * my + 0.12 * q.y, // at 35 %
    };
}

/** Returns where the line from a box's middle towards a point leaves the box. */
function border(box, x, y) {
    const dx = x - box.x, dy = y - box.y;
    const k = Math.min(dx ? (WIDE / 2 + 2) / Math.abs(dx) : Infinity, dy ? (HIGH / 2 + 2) / Math.abs(dy) : Infinity);
    return { x: box.x + k * dx, y: box.y + k * dy };
}
