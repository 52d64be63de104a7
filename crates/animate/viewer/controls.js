// The row below the picture, the keyboard, and the address: #t=3.2&view=ets&station=name&follow=name&az=210&el=25&zoom=1.2&still=1

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 5, 10];

class Controls {
    constructor(viewer) {
        this.viewer = viewer;
        const get = (id) => document.getElementById(id);
        this.play = get('play');
        this.slider = get('slider');
        this.clock = get('clock');
        this.view = get('view');
        this.follow = get('follow');
        const [start, end] = [viewer.start, viewer.end];
        Object.assign(this.slider, { min: start, max: end, step: (end - start) / 5000 || 1, value: start });
        this.slider.addEventListener('input', () => {
            viewer.pause();
            viewer.setTime(Number(this.slider.value));
        });
        this.play.addEventListener('click', () => viewer.toggle());
        options(get('speed'), SPEEDS.map((s) => [s, `${s}×`]), 1).addEventListener('change', (event) => {
            viewer.speed = Number(event.target.value);
        });
        const stations = viewer.agents.filter((agent) => agent.kind === 'ets');
        options(this.view, [['', 'overview'], ...stations.map((s) => [s.name, `camera on ${s.name}`])], '');
        this.view.addEventListener('change', () => viewer.look(this.view.value));
        const moving = viewer.agents.filter((agent) => agent.kind !== 'ets');
        options(this.follow, [['', 'nobody'], ...moving.map((a) => [a.name, a.name])], '');
        this.follow.addEventListener('change', () => viewer.followAgent(this.follow.value));
        window.addEventListener('keydown', (event) => this.key(event));
    }

    key(event) {
        if (event.target.tagName === 'SELECT' || event.ctrlKey || event.metaKey || event.altKey) return;
        const { viewer } = this;
        const step = event.shiftKey ? 1 : 0.1;
        const actions = {
            ' ': () => viewer.toggle(),
            ArrowLeft: () => viewer.setTime(viewer.time - step),
            ArrowRight: () => viewer.setTime(viewer.time + step),
            Home: () => viewer.setTime(viewer.start),
            End: () => viewer.setTime(viewer.end),
            v: () => viewer.nextView(),
        };
        const action = actions[event.key];
        if (!action) return;
        event.preventDefault();
        action();
    }

    show() {
        const { viewer } = this;
        this.play.textContent = viewer.playing ? 'Pause' : 'Play';
        this.slider.value = viewer.time;
        this.clock.textContent = `t = ${viewer.time.toFixed(2)} s of ${viewer.end.toFixed(2)} s`;
        this.view.value = viewer.view;
        this.follow.value = viewer.followed;
    }
}

/** Fills a select element: `[value, text]` each. */
function options(select, entries, chosen) {
    for (const [value, text] of entries) {
        const option = document.createElement('option');
        Object.assign(option, { value, textContent: text, selected: value === chosen });
        select.append(option);
    }
    return select;
}

/** What the address asks for. */
function readAddress() {
    return new URLSearchParams(window.location.hash.slice(1));
}

function followAddress(viewer) {
    const asked = readAddress();
    const number = (key) => (asked.has(key) && asked.get(key) !== '' ? Number(asked.get(key)) : NaN);
    document.body.classList.toggle('still', asked.has('still'));
    if (Number.isFinite(number('t'))) viewer.setTime(number('t'));
    viewer.orbitTo(...['az', 'el', 'zoom'].map(number));
    const station = asked.get('station') || viewer.firstStation();
    viewer.look(asked.get('view') === 'ets' ? station : '');
    viewer.showInset(station);
    viewer.followAgent(asked.get('follow') || '');
}
