// Keys that drive a player's agent: WASD or arrows, relative to the camera.

const KEYS = {
    w: [0, 1], arrowup: [0, 1], s: [0, -1], arrowdown: [0, -1],
    a: [-1, 0], arrowleft: [-1, 0], d: [1, 0], arrowright: [1, 0],
};

export class Player {
    /** `page`: {view, connection} */
    constructor(page) {
        this.page = page;
        this.ids = [];
        this.id = null;
        this.on = false;
        this.speed = 3; // m/s
        this.held = new Set();
        this.sent = "0 0";
        window.addEventListener("blur", () => this.letGo());
    }

    set(ids) {
        this.ids = ids ?? [];
        if (!this.ids.includes(this.id)) this.id = this.ids[0] ?? null;
        if (this.id === null) this.on = false;
    }

    /** True if the key is the player's. */
    key(event, down) {
        const key = event.key.toLowerCase();
        if (!this.on || this.id === null || !KEYS[key] || event.ctrlKey || event.metaKey || event.altKey) return false;
        if (down) this.held.add(key);
        else this.held.delete(key);
        this.send(event.shiftKey ? 0.5 : 1);
        return true;
    }

    letGo() {
        this.held.clear();
        if (this.on) this.send(1);
    }

    /** Sends the wanted velocity, in the directions of the picture, if it changed. */
    send(part) {
        let right = 0, up = 0;
        for (const key of this.held) {
            right += KEYS[key][0];
            up += KEYS[key][1];
        }
        const length = Math.hypot(right, up) || 1, size = (this.speed * part) / length;
        const m = this.page.view.camera.matrixWorld.elements; // its first column points right
        const flat = Math.hypot(m[0], m[1]) || 1, x = m[0] / flat, y = m[1] / flat;
        const vx = size * (right * x - up * y), vy = size * (right * y + up * x);
        const line = `${vx.toFixed(3)} ${vy.toFixed(3)}`;
        if (line === this.sent) return;
        if (this.page.connection.input("player", this.id, vx, vy)) this.sent = line;
    }
}
