// The viewer: reads the data of the page, builds the scene, and answers to `window.viewer`.

class Viewer {
    constructor(data) {
        this.data = data;
        this.start = data.t[0];
        this.end = data.t[data.t.length - 1];
        Object.assign(this, { time: this.start, speed: 1, playing: false, view: '', followed: '' });
        this.stage = new Stage(data);
        const kinds = { quadrotor: QuadrotorView, ets: StationView, target: TargetView };
        // Stations come last: they light the receivers of vehicles that are already there.
        const order = [...data.agents].sort((a, b) => (a.kind === 'ets') - (b.kind === 'ets'));
        for (const agent of order) this.stage.byName.set(agent.name, new kinds[agent.kind](agent, this.stage));
        this.agents = [...this.stage.byName.values()];
        this.inset = this.firstStation();
        this.labels = new Labels(document.getElementById('labels'), this.agents);
        this.plots = new Plots(document.getElementById('plots'), data, (t) => this.setTime(t));
        this.controls = new Controls(this);
        this.stage.inset.addEventListener('click', () => this.look(this.view ? '' : this.inset));
        this.stage.controls.addEventListener('change', () => this.redraw());
        window.addEventListener('resize', () => this.redraw());
        window.addEventListener('hashchange', () => followAddress(this));
    }

    firstStation() {
        const station = this.data.agents.find((agent) => agent.kind === 'ets');
        return station ? station.name : '';
    }

    /** Shows an instant, s, held inside the recording. */
    setTime(t) {
        this.time = Math.min(this.end, Math.max(this.start, Number(t) || 0));
        this.redraw();
    }

    play() {
        if (this.playing) return;
        if (this.time >= this.end) this.time = this.start;
        this.playing = true;
        let last = null;
        const advance = (now) => {
            if (!this.playing) return;
            const passed = last === null ? 0 : (now - last) / 1000;
            last = now;
            this.setTime(this.time + passed * this.speed);
            if (this.time >= this.end) this.pause();
            else window.requestAnimationFrame(advance);
        };
        window.requestAnimationFrame(advance);
        this.redraw();
    }

    pause() {
        this.playing = false;
        this.redraw();
    }

    toggle() {
        if (this.playing) this.pause();
        else this.play();
    }

    /** Shows what the camera on this station sees; the overview for an empty name. */
    look(station) {
        this.view = this.stage.byName.get(station)?.kind === 'ets' ? station : '';
        if (this.view) this.inset = this.view;
        this.redraw();
    }

    /** The station whose view is the small picture. */
    showInset(station) {
        if (this.stage.byName.get(station)?.kind === 'ets') this.inset = station;
        this.redraw();
    }

    nextView() {
        const stations = this.agents.filter((agent) => agent.kind === 'ets').map((agent) => agent.name);
        const views = ['', ...stations];
        this.look(views[(views.indexOf(this.view) + 1) % views.length]);
    }

    /** The overview moves along with this agent; with nobody for an empty name. */
    followAgent(name) {
        this.followed = this.stage.byName.has(name) ? name : '';
        this.carriedFrom = null;
        this.redraw();
    }

    orbitTo(azimuth, elevation, zoom) {
        this.stage.orbitTo(azimuth, elevation, zoom);
        this.carriedFrom = null;
        this.redraw();
    }

    /** One picture per frame of the screen, however often something changes. */
    redraw() {
        if (this.waiting) return;
        this.waiting = true;
        window.requestAnimationFrame(() => {
            this.waiting = false;
            this.draw();
        });
    }

    draw() {
        const at = placeInTime(this.data.t, this.time);
        for (const agent of this.agents) agent.moveTo(at, this.time, this.stage);
        const followed = this.stage.byName.get(this.followed);
        if (followed) {
            this.stage.carry(this.carriedFrom, followed.position);
            this.carriedFrom = followed.position.clone();
        }
        const station = this.stage.byName.get(this.view || this.inset);
        this.stage.draw(this.agents, station, Boolean(this.view), this.labels);
        this.plots.draw(this.time);
        this.controls.show();
    }

    /** Where an agent is drawn in the large picture, px of the page; null if it is behind. */
    whereOnScreen(name) {
        const agent = this.stage.byName.get(name);
        const station = this.stage.byName.get(this.view);
        const box = this.stage.box(station);
        const p = projected(toThree(agent.position), station ? station.camera : this.stage.eye, box);
        const corner = this.stage.element.getBoundingClientRect();
        return p && { x: p.x + corner.left, y: p.y + corner.top };
    }

    /** Where a station's camera sees a point of W, px right and down from the optical axis. */
    imageOf(station, [x, y, z]) {
        const { camera, agent } = this.stage.byName.get(station);
        const [w, h] = agent.lens.pixels;
        this.stage.scene.updateMatrixWorld(true);
        const p = projected(toThree(new THREE.Vector3(x, y, z)), camera, { x: 0, y: 0, w, h });
        return p && [p.x - agent.lens.principal[0], p.y - agent.lens.principal[1]];
    }

    /** The axes of W as three.js has them: rows N, E, D. */
    axesOfW() {
        return [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((axis) =>
            new THREE.Vector3(...axis).applyQuaternion(this.stage.world.quaternion).toArray());
    }
}

function complain(text) {
    const box = document.getElementById('message');
    box.textContent = text;
    box.hidden = false;
}

window.addEventListener('error', (event) => complain(`The animation stopped: ${event.message}`));
try {
    window.viewer = new Viewer(DATA);
    followAddress(window.viewer);
} catch (error) {
    complain(
        document.createElement('canvas').getContext('webgl2')
            ? `The animation can't be shown: ${error.message}`
            : 'This browser has no WebGL 2, which the animation is drawn with. Allow hardware acceleration, or try another browser.',
    );
    console.error(error);
}
