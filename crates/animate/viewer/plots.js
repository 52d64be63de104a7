// Range, incidence and spot offset of every station over time, with a cursor at the time shown.

const DASHES = [[], [7, 3], [2, 2.5], [8, 2.5, 2, 2.5]];

class Plots {
    constructor(canvas, data, seek) {
        Object.assign(this, { canvas, data });
        this.context = canvas.getContext('2d');
        this.byName = new Map(data.agents.map((agent) => [agent.name, agent]));
        this.stations = data.agents.filter((agent) => agent.kind === 'ets');
        const root = (agent) => agent.spotRight && agent.spotRight.map((right, k) => {
            const up = agent.spotUp[k];
            return right === null || up === null ? null : 1e3 * Math.hypot(right, up);
        });
        const degrees = (column) => column && column.map((x) => (x === null ? null : x / DEGREE));
        this.panels = [
            this.panel('Range R, m', (s) => s.range, (limits) => limits.range),
            this.panel('Incidence α, °', (s) => degrees(s.incidence), (limits) => limits.incidence / DEGREE),
            this.panel('Spot offset |s|, mm', root, (limits) => 1e3 * limits.spot),
        ].filter((panel) => panel.curves.length > 0);
        const move = (event) => {
            if (event.buttons !== 1) return;
            const { left, right } = this.frame(0);
            const x = event.clientX - canvas.getBoundingClientRect().left;
            seek(this.start() + ((x - left) / (right - left)) * (this.end() - this.start()));
        };
        canvas.addEventListener('pointerdown', move);
        canvas.addEventListener('pointermove', move);
    }

    start() {
        return this.data.t[0];
    }

    end() {
        return this.data.t[this.data.t.length - 1];
    }

    panel(title, column, limit) {
        const curves = this.stations
            .map((station, index) => ({ station, index, values: column(station) }))
            .filter((curve) => curve.values && curve.values.some((v) => v !== null));
        const limits = [...new Set(curves.map((curve) => limit(curve.station.limits)))];
        return { title, curves, limits, top: topOf(curves, limits) };
    }

    frame(index) {
        const { clientWidth: w, clientHeight: h } = this.canvas;
        const legend = 18 * this.stations.length + 8;
        const each = (h - legend - 38) / Math.max(1, this.panels.length);
        const top = legend + index * each;
        return { left: 46, right: w - 12, top: top + 20, bottom: top + each - 6 };
    }

    draw(t) {
        const { canvas, context } = this;
        const ratio = window.devicePixelRatio || 1;
        canvas.width = Math.round(canvas.clientWidth * ratio);
        canvas.height = Math.round(canvas.clientHeight * ratio);
        context.setTransform(ratio, 0, 0, ratio, 0, 0);
        context.font = '11.5px system-ui, sans-serif';
        this.legend();
        this.panels.forEach((panel, index) => this.drawPanel(panel, index, t));
    }

    legend() {
        const { context } = this;
        context.textAlign = 'left';
        context.textBaseline = 'middle';
        this.stations.forEach((station, i) => {
            const y = 12 + 18 * i;
            context.strokeStyle = this.colourOf(station, 0);
            context.lineWidth = 2;
            context.setLineDash(DASHES[i % DASHES.length]);
            tick(context, 46, y, 78, y);
            context.setLineDash([]);
            context.fillStyle = INK;
            context.fillText(station.tracks ? `${station.name} on ${station.tracks}` : station.name, 85, y);
        });
    }

    /** The colour of the level that the tracked vehicle has in this row. */
    colourOf(station, k) {
        const tracked = this.byName.get(station.tracks);
        return tracked && tracked.level ? levelColour(tracked.level[k]) : INK;
    }

    drawPanel(panel, index, t) {
        const { context } = this;
        const f = this.frame(index);
        const x = (time) => f.left + ((time - this.start()) / (this.end() - this.start() || 1)) * (f.right - f.left);
        const y = (value) => f.bottom - (value / panel.top) * (f.bottom - f.top);
        this.axes(panel, f, x, y, index === this.panels.length - 1);
        context.save();
        context.beginPath();
        context.rect(f.left, f.top - 1, f.right - f.left, f.bottom - f.top + 2);
        context.clip();
        context.strokeStyle = INK;
        context.lineWidth = 1;
        context.setLineDash([4, 3]);
        for (const limit of panel.limits) if (limit <= panel.top) tick(context, f.left, y(limit), f.right, y(limit));
        for (const curve of panel.curves) this.curve(curve, x, y);
        context.setLineDash([]);
        context.strokeStyle = '#8a1c1c';
        context.lineWidth = 1.2;
        tick(context, x(t), f.top, x(t), f.bottom);
        context.restore();
    }

    curve({ station, index, values }, x, y) {
        const { context, data } = this;
        context.lineWidth = 1.8;
        context.setLineDash(DASHES[index % DASHES.length]);
        let colour = null;
        let open = false;
        values.forEach((value, k) => {
            const now = this.colourOf(station, k);
            if (value === null || now !== colour) {
                if (open && value !== null) context.lineTo(x(data.t[k]), y(value));
                if (open) context.stroke();
                open = false;
                colour = now;
                context.strokeStyle = colour;
            }
            if (value === null) return;
            if (!open) context.beginPath();
            if (open) context.lineTo(x(data.t[k]), y(value));
            else context.moveTo(x(data.t[k]), y(value));
            open = true;
        });
        if (open) context.stroke();
    }

    axes(panel, f, x, y, last) {
        const { context } = this;
        context.strokeStyle = '#d4d4d4';
        context.fillStyle = INK;
        context.lineWidth = 1;
        context.textBaseline = 'middle';
        context.textAlign = 'right';
        for (const value of ticks(0, panel.top, 4)) {
            tick(context, f.left, y(value), f.right, y(value));
            context.fillText(trimmed(value), f.left - 6, y(value));
        }
        context.textAlign = 'center';
        context.textBaseline = 'top';
        for (const value of ticks(this.start(), this.end(), 5)) {
            tick(context, x(value), f.top, x(value), f.bottom);
            if (last) context.fillText(trimmed(value), x(value), f.bottom + 5);
        }
        if (last) context.fillText('Time t, s', (f.left + f.right) / 2, f.bottom + 20);
        context.strokeStyle = INK;
        context.strokeRect(f.left, f.top, f.right - f.left, f.bottom - f.top);
        context.textAlign = 'left';
        context.textBaseline = 'bottom';
        context.fillText(panel.title, f.left, f.top - 4);
        if (panel.limits.some((limit) => limit <= panel.top)) {
            context.textAlign = 'right';
            context.fillStyle = GREY;
            context.fillText('dashed: limit', f.right, f.top - 4);
        }
    }
}

/** Upper end of an axis: holds the limit and nine values in ten; an excursion, as in the search at first, leaves the picture. */
function topOf(curves, limits) {
    const values = curves.flatMap((curve) => curve.values.filter((v) => v !== null)).sort((a, b) => a - b);
    const most = values.length ? values[Math.floor(0.9 * (values.length - 1))] : 1;
    const near = limits.filter((limit) => limit < 4 * most);
    return 1.12 * Math.max(most, ...near, 1e-6);
}

/** Round numbers in a range, `count` or up to half as many more. */
function ticks(low, high, count) {
    const raw = (high - low) / count;
    if (!(raw > 0)) return [low];
    const power = 10 ** Math.floor(Math.log10(raw));
    const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= raw * 0.7);
    const found = [];
    for (let i = Math.ceil(low / step - 1e-9); i * step <= high * (1 + 1e-12) + 1e-12; i++) found.push(i * step);
    return found;
}

function trimmed(value) {
    return String(Number(value.toPrecision(6))).replace('-', '−');
}
