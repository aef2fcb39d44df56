// The picture as a PNG: what is drawn in three and in two dimensions, with a line of legend.
import { el } from "../dom.js";

/** Saves the picture; `title` becomes the file's name and its caption. */
export function savePicture(view, overlay, title) {
    view.sharpen(true);
    view.render(performance.now(), performance.now(), view.crowd.share(performance.now()));
    const canvas = el("canvas", { width: view.canvas.width, height: view.canvas.height });
    const pen = canvas.getContext("2d");
    pen.drawImage(view.canvas, 0, 0);
    overlay.draw(view.crowd.share(performance.now()));
    pen.drawImage(overlay.canvas, 0, 0, canvas.width, canvas.height);
    view.sharpen();
    const caption = `${title}, ${view.crowd.next ? view.crowd.next.time.toFixed(1) : 0} s`;
    pen.font = `${14 * view.screenRatio}px system-ui, sans-serif`;
    const wide = pen.measureText(caption).width;
    pen.fillStyle = "rgb(255 255 255 / 80%)";
    pen.fillRect(0, canvas.height - 28 * view.screenRatio, wide + 20 * view.screenRatio, 28 * view.screenRatio);
    pen.fillStyle = "#1d2126";
    pen.fillText(caption, 10 * view.screenRatio, canvas.height - 9 * view.screenRatio);
    canvas.toBlob((blob) => {
        const link = el("a", { href: URL.createObjectURL(blob), download: `${title.replace(/[^\w-]+/g, "-")}.png` });
        link.click();
        setTimeout(() => URL.revokeObjectURL(link.href), 10000);
    }, "image/png");
}
