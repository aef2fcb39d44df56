// Makes elements. Data from the server are only ever set as text.

/**
 * An element with properties and children. `on*` properties become listeners, `data-*`, `aria-*`,
 * `role` and `for` attributes, everything else a property. Strings become text.
 */
export function el(tag, properties = {}, ...children) {
    const node = document.createElement(tag);
    assign(node, properties);
    node.append(...children.flat(Infinity).filter((c) => c !== null && c !== undefined));
    return node;
}

const SVG = "http://www.w3.org/2000/svg";

/** An SVG element; every property is an attribute. */
export function svg(tag, attributes = {}, ...children) {
    const node = document.createElementNS(SVG, tag);
    for (const [name, value] of Object.entries(attributes)) {
        if (value !== null && value !== undefined) node.setAttribute(name, String(value));
    }
    node.append(...children.flat(Infinity));
    return node;
}

function assign(node, properties) {
    for (const [name, value] of Object.entries(properties)) {
        if (value === null || value === undefined) continue;
        if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
        else if (/^(data-|aria-|role$|for$)/.test(name)) node.setAttribute(name, value);
        else node[name] = value;
    }
}

/** Replaces the children of `node`. */
export function fill(node, ...children) {
    node.replaceChildren(...children.flat(Infinity).filter((c) => c !== null && c !== undefined));
    return node;
}

/** Sets text only if it changed, so that screen readers repeat nothing. */
export function say(node, text) {
    if (node.textContent !== text) node.textContent = text;
}

export function byId(id) {
    return document.getElementById(id);
}

/** A number with about three digits that matter, and thin spaces between thousands. */
export function figure(value) {
    if (value === null || value === undefined || Number.isNaN(value)) return "–";
    if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
    const size = Math.abs(value);
    if (size !== 0 && (size < 0.001 || size >= 1e9)) return value.toExponential(1);
    const digits = size >= 100 || Number.isInteger(value) ? 0 : size >= 10 ? 1 : 2;
    const text = size < 0.1 && size !== 0 ? String(Number(value.toPrecision(2))) : value.toFixed(digits);
    return text.replace("-", "−").replace(/\B(?=(\d{3})+$)/g, digits === 0 ? "\u202f" : "");
}

/** A measured figure with its unit. Below a thousandth it is shown as 0: rounding in sums leaves such rests. */
export function amount(value, unit) {
    return `${figure(Math.abs(value) < 0.001 ? 0 : value)} ${unit}`;
}

/** Seconds as m:ss.s */
export function clock(seconds) {
    const minutes = Math.floor(seconds / 60);
    const rest = (seconds - 60 * minutes).toFixed(1).padStart(4, "0");
    return `${minutes}:${rest}`;
}

/** What can have the focus within a node, in the order of Tab. */
function stops(node) {
    return [...node.querySelectorAll("button, select, input, a[href], [tabindex]")].filter((n) => !n.disabled && n.tabIndex >= 0 && n.getClientRects().length);
}

/** Moves the focus within a node: in a dialog Tab goes round; in a menu arrow keys move on from buttons, and Tab leaves it. */
export function moveFocus(node, kind) {
    node.addEventListener("keydown", (event) => {
        const all = stops(node), at = all.indexOf(document.activeElement);
        const step = kind === "menu" ? event.target instanceof HTMLButtonElement && { ArrowDown: 1, ArrowUp: -1 }[event.key]
            : event.key === "Tab" && (event.shiftKey ? -1 : 1);
        if (!step || all.length === 0 || (kind === "dialog" && all[at + step])) return; // within a dialog Tab does what it does
        event.preventDefault();
        event.stopPropagation();
        all[(at + step + all.length) % all.length].focus();
    });
}

/** Returns whether key presses belong to an input field. */
export function typing(event) {
    const target = event.target;
    return target instanceof HTMLInputElement && target.type !== "range" && target.type !== "checkbox"
        || target instanceof HTMLSelectElement || target instanceof HTMLTextAreaElement;
}
