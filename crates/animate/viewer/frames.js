// Frames and interpolation.
//
// W is north-east-down; three.js draws x right, y up, z towards the reader. North goes to x, east to z, down to -y: a
// turn by 90 degrees about north, no mirror. Everything that lives in W hangs below the group made here, with
// W's own numbers; attitudes are unit quaternions [x, y, z, w] from the agent's frame to W.

/** A vector of W in three.js' axes. */
function toThree(v) {
    return new THREE.Vector3(v.x, -v.z, v.y);
}

/** The group whose children live in W. */
function worldGroup() {
    const axis = (x, y, z) => toThree(new THREE.Vector3(x, y, z));
    const group = new THREE.Group();
    group.quaternion.setFromRotationMatrix(
        new THREE.Matrix4().makeBasis(axis(1, 0, 0), axis(0, 1, 0), axis(0, 0, 1)),
    );
    return group;
}

/** Where time t falls: between which rows (`k`, `k + 1`) and how far along (0 to 1). */
function placeInTime(times, t) {
    let low = 0;
    let high = times.length - 1;
    while (high - low > 1) {
        const middle = (low + high) >> 1;
        if (times[middle] <= t) low = middle;
        else high = middle;
    }
    const span = times[high] - times[low];
    const along = span > 0 ? (t - times[low]) / span : 0;
    return { k: low, next: high, along: Math.min(1, Math.max(0, along)) };
}

/** A number between its rows; null where a neighbour is missing. */
function between(column, at) {
    if (!column) return null;
    const [a, b] = [column[at.k], column[at.next]];
    return a === null || b === null ? null : a + (b - a) * at.along;
}

/** The row in force: what jumps (level, mode) is held, not interpolated. */
function held(column, at) {
    if (!column) return null;
    return column[at.along >= 1 ? at.next : at.k];
}

/** A position of W between rows, from three numbers per row. */
function positionAt(flat, at, into) {
    const of = (i) => flat[3 * at.k + i] * (1 - at.along) + flat[3 * at.next + i] * at.along;
    return into.set(of(0), of(1), of(2));
}

/** An attitude between rows: neighbours have the same sign, so the sum made a unit quaternion is enough. */
function attitudeAt(flat, at, into) {
    const of = (i) => flat[4 * at.k + i] * (1 - at.along) + flat[4 * at.next + i] * at.along;
    return into.set(of(0), of(1), of(2), of(3)).normalize();
}

const DEGREE = Math.PI / 180;

/** An angle in degrees from 0 up to 360. */
function compassDegrees(angle) {
    return (((angle / DEGREE) % 360) + 360) % 360;
}
