// Agents: what the recording says of each, moved to a time.

class QuadrotorView {
    constructor(agent, scene) {
        Object.assign(this, { agent, kind: 'quadrotor', name: agent.name, groundDepth: scene.data.ground });
        this.model = quadrotorModel({ arm: agent.arm });
        this.position = new THREE.Vector3();
        scene.world.add(this.model.group);
        this.receivers = agent.receivers.map((receiver) => {
            const drawn = receiverModel(receiver);
            drawn.station = receiver.station;
            this.model.group.add(drawn.group);
            return drawn;
        });
        this.addTrail(scene.world);
        this.addPlumbLine(scene.world);
    }

    addTrail(world) {
        const { p, level } = this.agent;
        const rows = p.length / 3;
        if (rows < 2) return;
        const colours = [];
        const colour = new THREE.Color();
        for (let k = 0; k < rows; k++) colours.push(...colour.set(levelColour(level ? level[k] : 0)).toArray());
        this.trail = wideLine(p, 3, { colours });
        const path = new THREE.BufferGeometry().setAttribute('position', new THREE.Float32BufferAttribute(p, 3));
        this.path = new THREE.Line(path, new THREE.LineBasicMaterial({ color: '#a5aaa5' }));
        world.add(this.path, this.trail);
    }

    /** A thin line to the ground and a shadow there, so that the eye can place the vehicle. */
    addPlumbLine(world) {
        const points = new THREE.BufferGeometry().setAttribute(
            'position', new THREE.Float32BufferAttribute([0, 0, 0, 0, 0, 1], 3));
        this.plumb = new THREE.LineSegments(points, new THREE.LineBasicMaterial({ color: '#9aa09a' }));
        const dark = new THREE.MeshBasicMaterial({ color: '#000000', transparent: true, opacity: 0.16, depthWrite: false });
        this.shadow = facingUp(new THREE.Mesh(new THREE.CircleGeometry(this.agent.arm * 1.3, 32), dark));
        world.add(this.plumb, this.shadow);
    }

    moveTo(at, t) {
        positionAt(this.agent.p, at, this.position);
        this.level = held(this.agent.level, at);
        this.model.group.position.copy(this.position);
        attitudeAt(this.agent.q, at, this.model.group.quaternion);
        this.model.paint(this.level);
        this.model.spin(t);
        if (this.trail) this.trail.geometry.instanceCount = Math.max(0, at.k + (at.along > 0 ? 1 : 0));
        if (this.trail) this.trail.visible = at.k + at.along > 0;
        this.plumb.position.copy(this.position);
        this.plumb.scale.z = Math.max(1e-3, this.groundDepth - this.position.z);
        this.shadow.position.set(this.position.x, this.position.y, this.groundDepth - 4e-3);
    }

    /** The beam of a station on this vehicle's receiver: offset to the right and up, m, and its radius there. */
    light(station, spot, radius) {
        for (const receiver of this.receivers) {
            if (receiver.station !== station) continue;
            receiver.spot.visible = spot !== null;
            if (!spot) continue;
            receiver.spot.position.x = spot[0];
            receiver.spot.position.y = spot[1];
            receiver.spot.scale.setScalar(radius);
        }
    }

    label() {
        return this.level === null ? this.name : `${this.name} · level ${this.level}`;
    }

    colour() {
        return levelColour(this.level);
    }
}

class StationView {
    constructor(agent, scene) {
        Object.assign(this, { agent, kind: 'ets', name: agent.name });
        this.position = new THREE.Vector3(...agent.position);
        const parts = stationModel(agent, scene.data.ground);
        this.yoke = parts.yoke;
        this.platform = new THREE.Group();
        this.platform.add(parts.head);
        this.frustum = frustumModel(agent.lens, scene.data.frustum);
        this.beam = wideLine([0, 0, 0, 1, 0, 0], 3, { colour: BEAM });
        this.beam.position.set(...agent.beam.offset);
        this.platform.add(this.frustum, this.beam);
        for (const part of [parts.column, parts.yoke, this.platform]) {
            part.position.copy(this.position);
            scene.world.add(part);
        }
        this.parts = [parts.column, parts.yoke, this.platform];
        this.camera = lensCamera(agent.lens);
        this.platform.add(this.camera);
    }

    moveTo(at, t, scene) {
        const { agent } = this;
        attitudeAt(agent.q, at, this.platform.quaternion);
        this.pan = between(agent.pan, at);
        this.tilt = between(agent.tilt, at);
        this.yoke.rotation.z = agent.heading + this.pan;
        this.range = between(agent.range, at);
        this.incidence = between(agent.incidence, at);
        const spot = [between(agent.spotRight, at), between(agent.spotUp, at)];
        this.spot = spot.includes(null) ? null : spot;
        this.mode = held(agent.mode, at);
        this.visible = held(agent.visible, at);
        this.tracked = scene.byName.get(agent.tracks);
        const meets = this.range !== null && this.incidence !== null && this.incidence < 89 * DEGREE;
        this.beam.scale.x = meets ? this.range : scene.data.extent;
        const { waist, divergence } = agent.beam;
        if (this.tracked && this.tracked.light) {
            const onFace = meets && this.spot && Math.hypot(...this.spot) < 3 ? this.spot : null;
            this.tracked.light(this.name, onFace, Math.hypot(waist, divergence * (this.range || 0)));
        }
    }

    /** What keeps it from seeing itself. */
    showBody(shown) {
        for (const part of this.parts) part.visible = shown || part === this.platform;
        this.platform.children.forEach((child) => (child.visible = shown || child === this.camera));
    }

    label() {
        return this.name;
    }

    colour() {
        return SKY_BLUE;
    }
}

class TargetView {
    constructor(agent, scene) {
        Object.assign(this, { agent, kind: 'target', name: agent.name });
        this.position = new THREE.Vector3();
        this.body = mesh(new THREE.SphereGeometry(0.1, 24, 16), INK);
        scene.world.add(this.body);
        if (agent.p.length > 3) {
            this.trail = wideLine(agent.p, 2, { colour: GREY });
            scene.world.add(this.trail);
        }
    }

    moveTo(at) {
        positionAt(this.agent.p, at, this.position);
        this.body.position.copy(this.position);
        if (this.trail) this.trail.geometry.instanceCount = Math.max(0, at.k + (at.along > 0 ? 1 : 0));
        if (this.trail) this.trail.visible = at.k + at.along > 0;
    }

    label() {
        return this.name;
    }

    colour() {
        return INK;
    }
}

/** A pinhole camera as the station's: it looks along x of the platform, y to the right, z down. */
function lensCamera(lens) {
    const camera = new THREE.PerspectiveCamera();
    camera.quaternion.setFromRotationMatrix(
        new THREE.Matrix4().makeBasis(
            new THREE.Vector3(0, 1, 0), new THREE.Vector3(0, 0, -1), new THREE.Vector3(-1, 0, 0)),
    );
    const near = 0.05;
    const slope = (pixels) => (pixels / lens.focal) * near;
    const [c, r] = lens.principal;
    camera.projectionMatrix.makePerspective(
        -slope(c), slope(lens.pixels[0] - c), slope(r), -slope(lens.pixels[1] - r), near, 500);
    camera.projectionMatrixInverse.copy(camera.projectionMatrix).invert();
    return camera;
}
