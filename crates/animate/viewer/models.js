// Bodies: built once in the agent's own frame (forward-right-down), then only moved.

function mesh(geometry, colour, extra = {}) {
    return new THREE.Mesh(geometry, new THREE.MeshLambertMaterial({ color: colour, ...extra }));
}

/** A cylinder along x, from 0 to `length`. */
function rod(length, radius, colour) {
    const body = mesh(new THREE.CylinderGeometry(radius, radius, length, 16), colour);
    body.rotation.z = -Math.PI / 2;
    body.position.x = length / 2;
    return body;
}

/** A flat thing that faces along -z (up) instead of three.js' +z. */
function facingUp(body) {
    body.rotation.x = Math.PI;
    return body;
}

/** Four rotors on crossed arms; the front arm is black and carries a cone. `paint(level)` colours the rest. */
function quadrotorModel(agent) {
    const group = new THREE.Group();
    const arm = agent.arm;
    const painted = [];
    const blades = [];
    for (let i = 0; i < 4; i++) {
        const side = new THREE.Group();
        side.rotation.z = (i * Math.PI) / 2;
        const front = i === 0;
        const boom = rod(arm, 0.06 * arm, front ? INK : '#ffffff');
        const motor = mesh(new THREE.CylinderGeometry(0.1 * arm, 0.1 * arm, 0.25 * arm, 16), INK);
        motor.rotation.x = Math.PI / 2;
        motor.position.set(arm, 0, -0.1 * arm);
        const ring = mesh(new THREE.TorusGeometry(0.58 * arm, 0.045 * arm, 8, 40), '#ffffff');
        ring.position.set(arm, 0, -0.25 * arm);
        const disc = facingUp(
            new THREE.Mesh(
                new THREE.CircleGeometry(0.58 * arm, 40),
                new THREE.MeshBasicMaterial({ transparent: true, opacity: 0.3, side: THREE.DoubleSide, depthWrite: false }),
            ),
        );
        disc.position.copy(ring.position);
        const blade = mesh(new THREE.BoxGeometry(1.1 * arm, 0.09 * arm, 0.02 * arm), INK);
        blade.position.copy(ring.position);
        blade.userData.sense = i % 2 ? 1 : -1;
        blades.push(blade);
        side.add(boom, motor, ring, disc, blade);
        painted.push(ring, disc);
        if (!front) painted.push(boom);
        group.add(side);
    }
    const hull = mesh(new THREE.SphereGeometry(0.26 * arm, 24, 16), '#ffffff');
    hull.scale.z = 0.6;
    const nose = mesh(new THREE.ConeGeometry(0.13 * arm, 0.34 * arm, 20), INK);
    nose.rotation.z = -Math.PI / 2;
    nose.position.x = 0.42 * arm;
    painted.push(hull);
    group.add(hull, nose);
    return {
        group,
        paint: (level) => painted.forEach((part) => part.material.color.set(levelColour(level))),
        spin: (t) => blades.forEach((blade) => (blade.rotation.z = blade.userData.sense * 25 * t)),
    };
}

/** The sensor on a vehicle: a dark panel with a bright edge, and on it the light of the beam. */
function receiverModel(receiver) {
    const group = new THREE.Group();
    const [e1, e2, n] = receiver.axes.map((axis) => new THREE.Vector3(...axis));
    group.quaternion.setFromRotationMatrix(new THREE.Matrix4().makeBasis(e1, e2, n));
    group.position.set(...receiver.offset);
    const { width, height } = receiver;
    const panel = mesh(new THREE.BoxGeometry(width, height, 0.01), '#24324a');
    const edge = mesh(new THREE.BoxGeometry(width * 1.06, height * 1.06, 0.006), '#f7f7f7');
    edge.position.z = -0.006;
    const spot = new THREE.Mesh(new THREE.CircleGeometry(1, 32), new THREE.MeshBasicMaterial({ color: '#3bea3b' }));
    spot.position.z = 0.009;
    group.add(panel, edge, spot);
    return { group, spot };
}

/** Column, yoke (turns by pan), head with camera and laser (turns with the platform). */
function stationModel(agent, groundDepth) {
    const column = new THREE.Group();
    const height = Math.max(0.05, groundDepth - agent.position[2]);
    const mast = mesh(new THREE.CylinderGeometry(0.035, 0.05, height, 20), '#4a4a4a');
    mast.rotation.x = Math.PI / 2;
    mast.position.z = height / 2 + 0.06;
    const foot = mesh(new THREE.CylinderGeometry(0.16, 0.2, 0.04, 28), '#4a4a4a');
    foot.rotation.x = Math.PI / 2;
    foot.position.z = height - 0.02;
    column.add(mast, foot);

    const yoke = new THREE.Group();
    for (const side of [-1, 1]) {
        const cheek = mesh(new THREE.BoxGeometry(0.07, 0.02, 0.2), '#6b6b6b');
        cheek.position.set(0, side * 0.11, 0.03);
        yoke.add(cheek);
    }
    const turntable = mesh(new THREE.CylinderGeometry(0.12, 0.12, 0.03, 28), '#6b6b6b');
    turntable.rotation.x = Math.PI / 2;
    turntable.position.z = 0.135;
    yoke.add(turntable);

    const head = new THREE.Group();
    const box = mesh(new THREE.BoxGeometry(0.24, 0.18, 0.16), SKY_BLUE);
    const barrel = rod(0.12, 0.05, INK);
    barrel.position.x += 0.1;
    const ring = mesh(new THREE.TorusGeometry(0.05, 0.012, 8, 32), '#f7f7f7');
    ring.rotation.y = Math.PI / 2;
    ring.position.x = 0.22;
    head.add(box, barrel, ring);
    return { column, yoke, head };
}

/** The camera's field of view to a depth along x of the platform: four edges, a frame and a breath of colour. */
function frustumModel(lens, depth) {
    const y = [-lens.principal[0], lens.pixels[0] - lens.principal[0]].map((p) => (p / lens.focal) * depth);
    const z = [-lens.principal[1], lens.pixels[1] - lens.principal[1]].map((p) => (p / lens.focal) * depth);
    const corners = [[y[0], z[0]], [y[1], z[0]], [y[1], z[1]], [y[0], z[1]]].map(([b, c]) => [depth, b, c]);
    const edges = corners.flatMap((corner, i) => [[0, 0, 0], corner, corner, corners[(i + 1) % 4]]);
    const faces = corners.flatMap((corner, i) => [[0, 0, 0], corner, corners[(i + 1) % 4]]);
    const geometry = (points) =>
        new THREE.BufferGeometry().setAttribute('position', new THREE.Float32BufferAttribute(points.flat(), 3));
    const group = new THREE.Group();
    group.add(
        new THREE.LineSegments(geometry(edges), new THREE.LineBasicMaterial({ color: '#4b7ea3' })),
        new THREE.Mesh(
            geometry(faces),
            new THREE.MeshBasicMaterial({
                color: SKY_BLUE, transparent: true, opacity: 0.1, side: THREE.DoubleSide, depthWrite: false,
            }),
        ),
    );
    return group;
}

/** A line of a width in px from points of W; `colours` are one per point. */
function wideLine(points, width, { colour, colours, opacity = 1 } = {}) {
    const geometry = new THREE.LineGeometry();
    geometry.setPositions(points);
    if (colours) geometry.setColors(colours);
    const material = new THREE.LineMaterial({
        linewidth: width,
        color: colours ? '#ffffff' : colour,
        vertexColors: Boolean(colours),
        transparent: opacity < 1,
        opacity,
    });
    const line = new THREE.Line2(geometry, material);
    line.frustumCulled = false;
    return line;
}
