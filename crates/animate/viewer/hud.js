// What is written over the view of the camera on a station: cross-hair, compass of its direction, scale of its inclination.

const CARDINALS = ['N', 'NE', 'E', 'SE', 'S', 'SW', 'W', 'NW'];
const PLATE = 'rgba(255, 255, 255, 0.82)';
const MODES = ['searching', 'coasting', 'tracking'];

/** Draws over the rectangle `box` (x, y, w, h in px) of the canvas. */
function drawHud(context, box, station) {
    const large = box.w > 420;
    context.save();
    context.beginPath();
    context.rect(box.x, box.y, box.w, box.h);
    context.clip();
    context.font = `${large ? 13 : 10.5}px system-ui, sans-serif`;
    crossHair(context, box, station.agent.lens);
    const pixelsPerRadian = (station.agent.lens.focal * box.w) / station.agent.lens.pixels[0];
    bearingTape(context, box, station, pixelsPerRadian, large);
    inclinationTape(context, box, station, pixelsPerRadian, large);
    if (large) {
        compassRose(context, { x: box.x + 84, y: box.y + box.h - 84, r: 56 }, station);
        inclinationGauge(context, { x: box.x + box.w - 184, y: box.y + box.h - 44, r: 78 }, station);
    }
    caption(context, box, station, large);
    context.restore();
    context.strokeStyle = INK;
    context.lineWidth = 1;
    context.strokeRect(box.x + 0.5, box.y + 0.5, box.w - 1, box.h - 1);
}

/** Where the optical axis meets the picture. */
function axisPoint(box, lens) {
    return {
        x: box.x + (box.w * lens.principal[0]) / lens.pixels[0],
        y: box.y + (box.h * lens.principal[1]) / lens.pixels[1],
    };
}

function crossHair(context, box, lens) {
    const c = axisPoint(box, lens);
    const [inner, outer] = [box.w * 0.02, box.w * 0.075];
    const strokes = () => {
        context.beginPath();
        for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
            context.moveTo(c.x + dx * inner, c.y + dy * inner);
            context.lineTo(c.x + dx * outer, c.y + dy * outer);
        }
        context.moveTo(c.x + outer * 0.72, c.y);
        context.arc(c.x, c.y, outer * 0.72, 0, 2 * Math.PI);
        context.stroke();
    };
    context.strokeStyle = 'rgba(255, 255, 255, 0.9)';
    context.lineWidth = 3.4;
    strokes();
    context.strokeStyle = INK;
    context.lineWidth = 1.2;
    strokes();
}

/** The compass along the upper edge: bearings from north, clockwise. */
function bearingTape(context, box, station, scale, large) {
    const height = large ? 34 : 22;
    const bearing = compassDegrees(station.agent.heading + station.pan);
    const middle = axisPoint(box, station.agent.lens).x;
    context.fillStyle = PLATE;
    context.fillRect(box.x, box.y, box.w, height);
    context.strokeStyle = context.fillStyle = INK;
    context.lineWidth = 1;
    context.textAlign = 'center';
    context.textBaseline = 'top';
    const span = box.w / scale / DEGREE;
    for (let d = Math.ceil((bearing - span) / 5) * 5; d <= bearing + span; d += 5) {
        const x = middle + (d - bearing) * DEGREE * scale;
        const named = d % (large ? 10 : 15) === 0;
        tick(context, x, box.y + height, x, box.y + height - (named ? 7 : 4));
        const turn = ((d % 360) + 360) % 360;
        const isWhole = x > box.x + 16 && x < box.x + box.w - 16;
        if (named && isWhole) context.fillText(turn % 45 === 0 ? CARDINALS[turn / 45] : `${turn}°`, x, box.y + (large ? 8 : 3));
    }
    pointer(context, middle, box.y + height, 0, 1);
}

/** The scale along the right edge: inclination of the camera above the horizon. */
function inclinationTape(context, box, station, scale, large) {
    const width = large ? 52 : 44;
    const top = box.y + (large ? 34 : 22);
    const tilt = station.tilt / DEGREE;
    const middle = axisPoint(box, station.agent.lens).y;
    context.save();
    context.beginPath();
    context.rect(box.x, top, box.w, box.y + box.h - top);
    context.clip();
    context.fillStyle = PLATE;
    context.fillRect(box.x + box.w - width, top, width, box.h);
    context.strokeStyle = context.fillStyle = INK;
    context.textAlign = 'right';
    context.textBaseline = 'middle';
    const left = box.x + box.w - width;
    for (let d = -90; d <= 90; d += 5) {
        const y = middle - (d - tilt) * DEGREE * scale;
        const named = d % 10 === 0;
        tick(context, left, y, left + (named ? 7 : 4), y);
        const isWhole = y > top + 7 && y < box.y + box.h - 7;
        if (named && isWhole) context.fillText(`${signed(d)}°`, box.x + box.w - 5, y);
    }
    context.restore();
    pointer(context, left, middle, -1, 0);
}

/** The compass seen from above: the sector is the field of view, the grey arc is what the gimbal can't reach. */
function compassRose(context, { x, y, r }, station) {
    const { heading, travel, lens } = station.agent;
    plate(context, x, y, r + 20);
    const at = (bearing, radius) => [x + radius * Math.sin(bearing), y - radius * Math.cos(bearing)];
    const sector = (from, to, radius, colour) => {
        context.fillStyle = colour;
        context.beginPath();
        context.moveTo(x, y);
        context.arc(x, y, radius, from - Math.PI / 2, to - Math.PI / 2);
        context.closePath();
        context.fill();
    };
    const free = 2 * Math.PI - (travel.pan[1] - travel.pan[0]);
    if (free > 0) sector(heading + travel.pan[1], heading + travel.pan[1] + free, r, 'rgba(0, 0, 0, 0.22)');
    const bearing = heading + station.pan;
    const half = [Math.atan(lens.principal[0] / lens.focal), Math.atan((lens.pixels[0] - lens.principal[0]) / lens.focal)];
    sector(bearing - half[0], bearing + half[1], r, 'rgba(86, 180, 233, 0.55)');
    context.strokeStyle = context.fillStyle = INK;
    context.lineWidth = 1;
    context.beginPath();
    context.arc(x, y, r, 0, 2 * Math.PI);
    context.stroke();
    for (let d = 0; d < 360; d += 10) tick(context, ...at(d * DEGREE, r), ...at(d * DEGREE, r - (d % 90 ? 4 : 8)));
    context.textAlign = 'center';
    context.textBaseline = 'middle';
    for (let i = 0; i < 8; i += 2) context.fillText(CARDINALS[i], ...at((i * Math.PI) / 4, r + 10));
    context.lineWidth = 2.2;
    tick(context, x, y, ...at(bearing, r - 2));
}

/** The inclination seen from the side, over the gimbal's travel. */
function inclinationGauge(context, { x, y, r }, station) {
    const { tilt } = station.agent.travel;
    const [low, high] = [Math.max(tilt[0], -Math.PI / 2), Math.min(tilt[1], Math.PI / 2)];
    const at = (angle, radius) => [x + radius * Math.cos(angle), y - radius * Math.sin(angle)];
    context.fillStyle = PLATE;
    context.fillRect(x - 16, y - r - 18, r + 64, r + 18 + 40);
    context.strokeStyle = context.fillStyle = INK;
    context.lineWidth = 1;
    context.beginPath();
    context.arc(x, y, r, -high, -low);
    context.stroke();
    context.textAlign = 'left';
    context.textBaseline = 'middle';
    for (let d = Math.ceil(low / DEGREE / 10) * 10; d <= high / DEGREE + 1e-9; d += 10) {
        tick(context, ...at(d * DEGREE, r), ...at(d * DEGREE, r - (d % 30 ? 4 : 8)));
        if (d % 30 === 0) context.fillText(`${signed(d)}°`, ...at(d * DEGREE, r + 6));
    }
    context.setLineDash([3, 3]);
    tick(context, x, y, ...at(0, r));
    context.setLineDash([]);
    context.lineWidth = 2.2;
    tick(context, x, y, ...at(station.tilt, r - 2));
}

function caption(context, box, station, large) {
    const bearing = compassDegrees(station.agent.heading + station.pan);
    const words = [`${station.name}: bearing ${bearing.toFixed(1)}°, inclination ${signed(station.tilt / DEGREE, 1)}°`];
    if (station.mode !== null) words.push(MODES[station.mode] || '');
    if (large && station.range !== null) words.push(`range ${station.range.toFixed(2)} m`);
    let text = words.join(' · ');
    while (words.length > 1 && context.measureText(text).width + 14 > box.w) {
        words.pop();
        text = words.join(' · ');
    }
    const width = context.measureText(text).width + 14;
    const height = large ? 24 : 17;
    const x = large ? box.x + (box.w - width) / 2 : box.x;
    context.fillStyle = PLATE;
    context.fillRect(x, box.y + box.h - height, width, height);
    context.fillStyle = INK;
    context.textAlign = 'left';
    context.textBaseline = 'middle';
    context.fillText(text, x + 7, box.y + box.h - height / 2 + 0.5);
}

/** The axes of W as the overview is turned, in its lower left corner; the grid's width beside them. */
function drawTriad(context, box, camera) {
    const [x, y, length] = [box.x + 52, box.y + box.h - 46, 30];
    const turn = camera.quaternion.clone().invert();
    context.save();
    context.font = '12.5px system-ui, sans-serif';
    context.textAlign = 'center';
    context.textBaseline = 'middle';
    context.lineWidth = 2;
    context.strokeStyle = context.fillStyle = INK;
    [['N', 1, 0, 0], ['E', 0, 1, 0], ['D', 0, 0, 1]].forEach(([name, ...axis]) => {
        const seen = toThree(new THREE.Vector3(...axis)).applyQuaternion(turn);
        tick(context, x, y, x + length * seen.x, y - length * seen.y);
        const reach = length + 11 / Math.max(0.35, Math.hypot(seen.x, seen.y));
        context.fillText(name, x + reach * seen.x, y - reach * seen.y);
    });
    context.textAlign = 'left';
    context.fillStyle = '#4a4a4a';
    context.fillText('grid 1 m', x + 52, y + 28);
    context.restore();
}

function tick(context, x0, y0, x1, y1) {
    context.beginPath();
    context.moveTo(x0, y0);
    context.lineTo(x1, y1);
    context.stroke();
}

/** A small triangle whose tip touches (x, y) from the side (dx, dy). */
function pointer(context, x, y, dx, dy) {
    context.fillStyle = '#d55e00';
    context.beginPath();
    context.moveTo(x, y);
    context.lineTo(x + 9 * dx - 5 * dy, y + 9 * dy - 5 * dx);
    context.lineTo(x + 9 * dx + 5 * dy, y + 9 * dy + 5 * dx);
    context.closePath();
    context.fill();
}

function plate(context, x, y, radius) {
    context.fillStyle = PLATE;
    context.beginPath();
    context.arc(x, y, radius, 0, 2 * Math.PI);
    context.fill();
}

/** A number with a true minus. */
function signed(value, digits = 0) {
    return value.toFixed(digits).replace('-', '−').replace(/^−(0(\.0*)?)$/, '$1');
}
