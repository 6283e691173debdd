// What the viewer uses of three.js; esbuild bundles it into three.min.js (make page-libraries).
export {
  BoxGeometry, BufferAttribute, BufferGeometry, Color, ColorManagement, DynamicDrawUsage, EdgesGeometry, InstancedBufferAttribute,
  InstancedBufferGeometry, Line, LineBasicMaterial, LineSegments, LinearSRGBColorSpace, Mesh, MeshBasicMaterial,
  PerspectiveCamera, PlaneGeometry, Scene, ShaderMaterial, Vector3, WebGLRenderer, DoubleSide
} from "three";
export {OrbitControls} from "three/addons/controls/OrbitControls.js";
