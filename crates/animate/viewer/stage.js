// The scene and its two pictures: the overview, and the camera on a station; one is large, the other an inset.

class Stage {
    constructor(data) {
        this.data = data;
        this.scene = new THREE.Scene();
        this.scene.background = new THREE.Color(SKY);
        this.world = worldGroup();
        this.scene.add(this.world, new THREE.HemisphereLight('#ffffff', '#b8bbb5', 2.2));
        const sun = new THREE.DirectionalLight('#ffffff', 1.6);
        sun.position.set(-4, 9, 6);
        this.scene.add(sun);
        this.byName = new Map();
        this.element = document.getElementById('stage');
        this.overlay = document.getElementById('overlay');
        this.inset = document.getElementById('inset');
        this.renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
        this.renderer.autoClear = false;
        this.element.prepend(this.renderer.domElement);
        this.eye = new THREE.PerspectiveCamera(36, 1, 0.05, 400);
        this.controls = new THREE.OrbitControls(this.eye, this.renderer.domElement);
        this.controls.maxPolarAngle = 0.495 * Math.PI;
        this.addGround();
        this.orbitTo(data.camera.azimuth, data.camera.elevation, data.camera.zoom);
    }

    /** The ground with a grid of one metre. */
    addGround() {
        const { ground, extent, centre } = this.data;
        const size = 2 * Math.ceil(extent * 1.8);
        const [north, east] = centre.map(Math.round);
        const floor = facingUp(new THREE.Mesh(new THREE.CircleGeometry(150, 64), new THREE.MeshBasicMaterial({ color: GROUND })));
        floor.position.z = ground + 0.012;
        const grid = new THREE.GridHelper(size, size, GRID, GRID);
        grid.rotation.x = Math.PI / 2;
        grid.position.set(north, east, ground);
        this.world.add(floor, grid);
    }

    /** Looks at the scene from this azimuth (from north, clockwise) and elevation, degrees, from where all of it is seen. */
    orbitTo(azimuth, elevation, zoom) {
        const { camera, middle } = this.data;
        const or = (value, other) => (Number.isFinite(value) ? value : other);
        const [a, e] = [or(azimuth, camera.azimuth) * DEGREE, or(elevation, camera.elevation) * DEGREE];
        const back = toThree(new THREE.Vector3(Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), -Math.sin(e)));
        const right = new THREE.Vector3(0, 1, 0).cross(back).normalize();
        const up = back.clone().cross(right);
        const points = this.landmarks().map((p) => toThree(p.sub(new THREE.Vector3(...middle))));
        const { w, h } = this.size();
        // What is left of half the picture's height and width beside names and edges.
        const slope = Math.tan((this.eye.fov / 2) * DEGREE);
        const [across, high] = [0.8 * slope * (w / h), 0.8 * slope];
        const seen = (p, far) => ({ x: p.dot(right) / (far - p.dot(back)), y: p.dot(up) / (far - p.dot(back)) });
        // The centre is moved until the picture is balanced, and the distance grows until everything fits.
        const shift = new THREE.Vector3();
        let far = 1;
        for (let round = 0; round < 12; round++) {
            const moved = points.map((p) => p.clone().sub(shift));
            const needs = moved.map((p) => p.dot(back) + Math.max(Math.abs(p.dot(right)) / across, Math.abs(p.dot(up)) / high));
            far = Math.max(1, ...needs);
            const [xs, ys] = [moved.map((p) => seen(p, far).x), moved.map((p) => seen(p, far).y)];
            const middleOf = (v) => (Math.min(...v) + Math.max(...v)) / 2;
            shift.addScaledVector(right, middleOf(xs) * far * 0.7).addScaledVector(up, middleOf(ys) * far * 0.7);
        }
        this.controls.target.copy(toThree(new THREE.Vector3(...middle)).add(shift));
        this.eye.position.copy(this.controls.target).addScaledVector(back, far / or(zoom, camera.zoom));
        this.controls.update();
    }

    /** Points of W that the overview should hold. */
    landmarks() {
        const points = [];
        for (const agent of this.data.agents) {
            const flat = agent.p || agent.position;
            const rows = flat.length / 3;
            const every = Math.max(1, Math.floor(rows / 100));
            for (let k = 0; k < rows; k += every) points.push(new THREE.Vector3(flat[3 * k], flat[3 * k + 1], flat[3 * k + 2]));
            if (agent.kind === 'ets') points.push(new THREE.Vector3(flat[0], flat[1], this.data.ground));
        }
        return points;
    }

    /** Moves eye and centre of the overview by as much as what is followed; at first, to it. */
    carry(from, to) {
        const shift = toThree(to).sub(from ? toThree(from) : this.controls.target);
        this.eye.position.add(shift);
        this.controls.target.add(shift);
        this.controls.update();
    }

    /** Size of the large picture, px; never zero. */
    size() {
        return { w: Math.max(1, this.element.clientWidth), h: Math.max(1, this.element.clientHeight) };
    }

    resize() {
        const { w, h } = this.size();
        const ratio = window.devicePixelRatio || 1;
        this.renderer.setPixelRatio(ratio);
        this.renderer.setSize(w, h, false);
        for (const canvas of [this.overlay, this.inset]) {
            canvas.width = Math.round(canvas.clientWidth * ratio);
            canvas.height = Math.round(canvas.clientHeight * ratio);
            canvas.getContext('2d').setTransform(ratio, 0, 0, ratio, 0, 0);
        }
        return ratio;
    }

    /** The rectangle of the large picture, px; a station's picture keeps its proportions. */
    box(station) {
        const { w, h } = this.size();
        return station ? fitted({ x: 0, y: 0, w, h }, station.agent.lens.pixels) : { x: 0, y: 0, w, h };
    }

    /** Draws the overview large and the station's view as the inset, or the other way round. */
    draw(agents, station, isLarge, labels) {
        const ratio = this.resize();
        this.inset.hidden = !station;
        this.renderer.setScissorTest(false);
        this.renderer.setClearColor('#3a3f44');
        this.renderer.clear();
        if (station) this.drawInset(station, isLarge, ratio);
        this.renderer.setScissorTest(false);
        this.renderer.clear();
        const box = this.box(isLarge ? station : null);
        const context = this.overlay.getContext('2d');
        this.render(box, isLarge ? station : null);
        if (isLarge) drawHud(context, box, station);
        else drawTriad(context, box, this.eye);
        labels.place(isLarge ? station.camera : this.eye, box, (agent) => isLarge && agent === station);
    }

    /** The small picture: drawn in a corner of the large one, then copied. */
    drawInset(station, isLarge, ratio) {
        const { clientWidth, clientHeight } = this.inset;
        const { w, h } = this.size();
        const size = { x: 0, y: 0, w: Math.min(clientWidth, w), h: Math.min(clientHeight, h) };
        const box = isLarge ? size : fitted(size, station.agent.lens.pixels);
        this.render({ ...box, y: h - box.h, x: 0 }, isLarge ? null : station);
        const context = this.inset.getContext('2d');
        const source = [0, Math.round((h - box.h) * ratio), Math.round(box.w * ratio), Math.round(box.h * ratio)];
        context.drawImage(this.renderer.domElement, ...source, box.x, box.y, box.w, box.h);
        if (isLarge) drawTriad(context, box, this.eye);
        else drawHud(context, box, station);
    }

    /** Draws what a station's camera sees into a rectangle, or the overview for no station. */
    render(box, station) {
        const fromBelow = this.size().h - box.y - box.h;
        this.renderer.setViewport(box.x, fromBelow, box.w, box.h);
        this.renderer.setScissor(box.x, fromBelow, box.w, box.h);
        this.renderer.setScissorTest(true);
        this.renderer.clear();
        if (!station) {
            this.eye.aspect = box.w / box.h;
            this.eye.updateProjectionMatrix();
        }
        station?.showBody(false);
        this.renderer.render(this.scene, station ? station.camera : this.eye);
        station?.showBody(true);
    }
}

/** The largest rectangle of these proportions in the middle of a box. */
function fitted(box, [columns, rows]) {
    const scale = Math.min(box.w / columns, box.h / rows);
    const [w, h] = [Math.floor(columns * scale), Math.floor(rows * scale)];
    return { x: box.x + Math.floor((box.w - w) / 2), y: box.y + Math.floor((box.h - h) / 2), w, h };
}
