// A gamepad drives the player by its left stick or its cross; its front buttons are the player's button. On a card they
// press the main button.

const DEAD = 0.2; // part of a stick's way in which it counts as released
const CROSS = { 12: [0, 1], 13: [0, -1], 14: [-1, 0], 15: [1, 0] }; // buttons of the standard mapping
const FRONT = [0, 1, 2, 3, 5, 7];

/** Returns a stick's direction without its dead zone: right and up, together at most 1. */
export function readStick(x, y) {
    const far = Math.hypot(x, y), part = far > DEAD ? Math.min(1, (far - DEAD) / (1 - DEAD)) / far : 0;
    return [x * part, -y * part];
}

export class Gamepads {
    /** `player`: takes the stick; `press`: called when a button goes down. */
    constructor(player, press) {
        this.player = player;
        this.press = press;
        this.down = false;
        this.used = false;
    }

    /** Reads the first gamepad; called for each picture. */
    poll() {
        const pad = [...(navigator.getGamepads?.() ?? [])].find((p) => p?.connected);
        if (!pad) {
            if (this.used) this.player.stick("gamepad", 0, 0, false);
            this.used = false;
            return;
        }
        this.used = true;
        let [right, up] = readStick(pad.axes[0] ?? 0, pad.axes[1] ?? 0);
        for (const [button, way] of Object.entries(CROSS)) if (pad.buttons[button]?.pressed) [right, up] = way;
        const down = FRONT.some((button) => pad.buttons[button]?.pressed);
        this.player.stick("gamepad", right, up, down);
        if (down && !this.down) this.press();
        this.down = down;
    }
}
