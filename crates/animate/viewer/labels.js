// Names beside the agents, as elements of the page: sharp at any size, and text is never taken for HTML.

class Labels {
    constructor(layer, agents) {
        this.items = agents.map((agent) => {
            const element = document.createElement('div');
            element.className = 'label';
            layer.append(element);
            return { agent, element };
        });
    }

    /** Puts every label above its agent as this camera sees it in this box; who tells which agents are left out. */
    place(camera, box, isLeftOut) {
        const taken = [];
        for (const { agent, element } of this.items) {
            const p = projected(toThree(agent.position), camera, box);
            element.hidden = !p || isLeftOut(agent);
            if (element.hidden) continue;
            element.textContent = agent.label();
            element.style.borderLeftColor = agent.colour();
            const { offsetWidth: w, offsetHeight: h } = element;
            const x = Math.min(Math.max(p.x - w / 2, box.x + 2), box.x + box.w - w - 2);
            let y = p.y - h - p.clear;
            // A label that would lie on another moves up.
            for (const other of taken) if (Math.abs(other.x - x) < (other.w + w) / 2 && Math.abs(other.y - y) < h) y = other.y - h - 2;
            taken.push({ x, y, w });
            element.style.transform = `translate(${x}px, ${Math.max(y, box.y + 2)}px)`;
        }
    }
}

/** Where a camera sees a point, px in the stage; null behind it. `clear` keeps labels off a body of half a metre. */
function projected(point, camera, box) {
    camera.updateWorldMatrix(true, false);
    const view = point.clone().applyMatrix4(camera.matrixWorld.clone().invert());
    if (view.z > -0.05) return null;
    const ndc = view.clone().applyMatrix4(camera.projectionMatrix);
    return {
        x: box.x + ((ndc.x + 1) / 2) * box.w,
        y: box.y + ((1 - ndc.y) / 2) * box.h,
        clear: Math.min(90, (0.34 * camera.projectionMatrix.elements[5] * box.h) / 2 / -view.z),
    };
}
