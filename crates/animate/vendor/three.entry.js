// What the viewer uses of three.js; `tools/vendor-three.sh` bundles it into three.bundle.js.
export {
    AmbientLight, BoxGeometry, BufferAttribute, BufferGeometry, CircleGeometry, Color, ConeGeometry, CylinderGeometry,
    DirectionalLight, DoubleSide, Float32BufferAttribute, Fog, GridHelper, Group, HemisphereLight, Line, LineBasicMaterial,
    LineDashedMaterial, LineSegments, Matrix4, Mesh, MeshBasicMaterial, MeshLambertMaterial, PerspectiveCamera,
    PlaneGeometry, Quaternion, RingGeometry, Scene, SphereGeometry, TorusGeometry, Vector2, Vector3, WebGLRenderer,
} from 'three';
export { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
export { Line2 } from 'three/examples/jsm/lines/Line2.js';
export { LineGeometry } from 'three/examples/jsm/lines/LineGeometry.js';
export { LineMaterial } from 'three/examples/jsm/lines/LineMaterial.js';
