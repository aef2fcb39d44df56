// Icons of the bar: lines on a field of 24 by 24, in the colour of the text around them.
import { svg } from "../dom.js";

const PATHS = {
    play: "M8 5l11 7-11 7z",
    pause: "M8 5v14M16 5v14",
    step: "M6 5l9 7-9 7zM18.5 5v14",
    restart: "M5 12a7 7 0 1 0 2.4-5.3M5 4v4.5h4.5",
    select: "M6 4l12 8.5-5.5 1L16 20l-2.5 1-3-6.3L6 18.5z",
    throw: "M3 18C6 8 12 6 16.5 12M16.8 7v5.2h-5.2M15 16h5v5h-5z",
    drag: "M12 3v18M3 12h18M9.5 5.5L12 3l2.5 2.5M9.5 18.5L12 21l2.5-2.5M5.5 9.5L3 12l2.5 2.5M18.5 9.5L21 12l-2.5 2.5",
    push: "M3 12h10M9.5 8.5L13 12l-3.5 3.5M18 6a1.8 1.8 0 1 0 .01 0M16 21v-8.5a2 2 0 0 1 4 0V21",
    colour: "M12 3a9 9 0 1 0 0 18c2 0 1.8-1.6 1.2-2.6-.7-1.3.2-2.6 1.8-2.6h2.3A3.7 3.7 0 0 0 21 12c0-5-4-9-9-9zM7.5 11.5h.01M11 7.5h.01M15.5 8.5h.01",
    floor: "M3 13l9-6 9 6-9 6zM7.5 10l9 6M16.5 10l-9 6",
    top: "M3 8.5c3-5 15-5 18 0-3 5-15 5-18 0zM12 7a1.5 1.5 0 1 0 .01 0M12 15v6M9 18l3 3 3-3",
    follow: "M12 8a4 4 0 1 0 .01 0M12 2.5v4M12 17.5v4M2.5 12h4M17.5 12h4",
    home: "M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5M9 9h6v6H9z",
    names: "M3 12V4h8l10 10-7.5 7.5zM7.5 8.5h.01",
    picture: "M3 7.5h4L9 5h6l2 2.5h4V19H3zM12 9.5a3.5 3.5 0 1 0 .01 0",
    help: "M9 9a3 3 0 1 1 4.5 2.6c-1 .6-1.5 1.2-1.5 2.4M12 18h.01M12 3a9 9 0 1 0 .01 0",
    about: "M12 3a9 9 0 1 0 .01 0M12 11v6M12 7.5h.01",
    more: "M5.5 12h.01M12 12h.01M18.5 12h.01",
};
const FILLED = new Set(["play"]);

export function icon(name) {
    return svg("svg", { "class": "icon", viewBox: "0 0 24 24", "aria-hidden": "true" },
        svg("path", { d: PATHS[name], fill: FILLED.has(name) ? "currentColor" : "none" }));
}
