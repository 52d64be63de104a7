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
        this.renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
        this.renderer.autoClear = false;
        this.element.prepend(this.renderer.domElement);
        this.eye = new THREE.PerspectiveCamera(36, 1, 0.05, 400);
        this.controls = new THREE.OrbitControls(this.eye, this.renderer.domElement);
        this.controls.maxPolarAngle = 0.495 * Math.PI;
        this.addGround();
        this.orbitTo(data.camera.azimuth, data.camera.elevation, data.camera.zoom);
    }

    /** The ground with a grid of one metre, north's arrow and the axes of W. */
    addGround() {
        const { ground, extent, centre } = this.data;
        const size = 2 * Math.ceil(extent * 1.4);
        const [north, east] = centre.map(Math.round);
        const floor = facingUp(new THREE.Mesh(new THREE.CircleGeometry(150, 64), new THREE.MeshBasicMaterial({ color: GROUND })));
        floor.position.z = ground + 0.012;
        const grid = new THREE.GridHelper(size, size, GRID, GRID);
        grid.rotation.x = Math.PI / 2;
        grid.position.set(north, east, ground);
        const corner = new THREE.Vector3(north - Math.ceil(extent * 0.75), east - Math.ceil(extent * 0.75), ground - 5e-3);
        this.axes = ['N', 'E', 'D'].map((name, i) => {
            const axis = new THREE.Group();
            const length = i === 2 ? 0.5 : 1;
            axis.add(rod(length, 0.018, INK));
            const tip = mesh(new THREE.ConeGeometry(0.06, 0.18, 20), INK);
            tip.rotation.z = -Math.PI / 2;
            tip.position.x = length + 0.09;
            axis.add(tip);
            // Down starts half a metre up, so that it ends at the ground.
            axis.position.copy(corner).add(new THREE.Vector3(0, 0, i === 2 ? -0.6 : 0));
            if (i === 1) axis.rotation.z = Math.PI / 2;
            if (i === 2) axis.rotation.y = -Math.PI / 2;
            this.world.add(axis);
            const end = [[1.4, 0, 0], [0, 1.4, 0], [0, 0, -0.85]][i];
            return { name, position: corner.clone().add(new THREE.Vector3(...end)), label: () => name, colour: () => 'transparent' };
        });
        this.world.add(floor, grid);
    }

    /** Looks at the middle of the scene from this azimuth (from north, clockwise) and elevation, degrees. */
    orbitTo(azimuth, elevation, zoom) {
        const { camera, middle, extent } = this.data;
        const or = (value, other) => (Number.isFinite(value) ? value : other);
        const [a, e] = [or(azimuth, camera.azimuth) * DEGREE, or(elevation, camera.elevation) * DEGREE];
        const far = (2.3 * extent) / or(zoom, camera.zoom);
        const from = new THREE.Vector3(Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), -Math.sin(e));
        const centre = new THREE.Vector3(...middle);
        this.controls.target.copy(toThree(centre));
        this.eye.position.copy(toThree(centre.clone().addScaledVector(from, far)));
        this.controls.update();
    }

    /** Moves eye and centre of the overview by as much as what is followed. */
    carry(from, to) {
        const shift = toThree(to.clone().sub(from));
        this.eye.position.add(shift);
        this.controls.target.add(shift);
        this.controls.update();
    }

    resize() {
        const { clientWidth: w, clientHeight: h } = this.element;
        const ratio = window.devicePixelRatio || 1;
        this.renderer.setPixelRatio(ratio);
        this.renderer.setSize(w, h, false);
        this.overlay.width = Math.round(w * ratio);
        this.overlay.height = Math.round(h * ratio);
        return { w, h, ratio };
    }

    /** The rectangles of the large picture and of the inset, px; a station's picture keeps its proportions. */
    boxes(station, isLarge) {
        const { clientWidth: w, clientHeight: h } = this.element;
        const whole = { x: 0, y: 0, w, h };
        if (!station) return { overview: whole, lens: null };
        const [columns, rows] = station.agent.lens.pixels;
        if (isLarge) {
            const scale = Math.min(w / columns, h / rows);
            const lens = { w: Math.floor(columns * scale), h: Math.floor(rows * scale) };
            return { overview: null, lens: { x: Math.floor((w - lens.w) / 2), y: Math.floor((h - lens.h) / 2), ...lens } };
        }
        const width = Math.floor(Math.min(0.36 * w, 300));
        const height = Math.floor((width * rows) / columns);
        return { overview: whole, lens: { x: 12, y: h - height - 12, w: width, h: height } };
    }

    draw(agents, station, isLarge, labels) {
        const { ratio } = this.resize();
        const boxes = this.boxes(station, isLarge);
        const context = this.overlay.getContext('2d');
        context.setTransform(ratio, 0, 0, ratio, 0, 0);
        context.clearRect(0, 0, this.overlay.width, this.overlay.height);
        this.renderer.setScissorTest(false);
        this.renderer.setClearColor('#3a3f44');
        this.renderer.clear();
        if (boxes.overview) {
            this.eye.aspect = boxes.overview.w / boxes.overview.h;
            this.eye.updateProjectionMatrix();
            this.render(boxes.overview, this.eye, agents);
            labels.place(this.eye, boxes.overview, (agent) => inside(agent, boxes.lens, this.eye, boxes.overview));
        }
        if (boxes.lens) {
            station.showBody(false);
            this.render(boxes.lens, station.camera, agents);
            station.showBody(true);
            if (isLarge) labels.place(station.camera, boxes.lens, (agent) => agent === station);
            drawHud(context, boxes.lens, station);
        }
    }

    render(box, camera, agents) {
        const fromBelow = this.element.clientHeight - box.y - box.h;
        this.renderer.setViewport(box.x, fromBelow, box.w, box.h);
        this.renderer.setScissor(box.x, fromBelow, box.w, box.h);
        this.renderer.setScissorTest(true);
        this.renderer.clear();
        this.renderer.render(this.scene, camera);
    }
}

/** Whether an agent is drawn where the inset covers the overview. */
function inside(agent, inset, camera, box) {
    if (!inset) return false;
    const p = projected(toThree(agent.position), camera, box);
    return p && p.x > inset.x && p.x < inset.x + inset.w && p.y > inset.y && p.y < inset.y + inset.h;
}
