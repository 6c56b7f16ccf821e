// The robot of report.html in 3-D: its motion, its parts moved apart, the steps of its assembly.
// Lengths are metres, z is up. What is shown comes from the page: a GLB file in base64, and data in JSON.

import {
  AmbientLight, Box3, BufferGeometry, CircleGeometry, Color, DirectionalLight, Float32BufferAttribute, Group, Line,
  LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial, PerspectiveCamera, Quaternion, Raycaster, Scene, SphereGeometry,
  Vector2, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";

// The first view: from which side (along, across, up), and the share of the picture that robot and jump fill.
const FROM = [0.2, -1, 0.24];
const FILLED = 0.92;
// Share of the rise by which a camera that follows goes up with the robot: the ground stays in view.
const RISING = 0.85;
// The radius of the shadow of a robot on the ground, as a share of its size.
const SHADOW = 0.55;
// The most that a picture goes on (s): after a pause of the browser the motion goes on where it was.
const LONGEST_S = 0.25;
// A key turns by 7.5°, moves by a twelfth of the robot's size, zooms by a seventh, and goes a fiftieth of a second on.
const TURN = Math.PI / 24;
const MOVE = 1 / 12;
const ZOOM = 1.15;
const MOMENT_S = 0.02;
const HINT = "Click on a part, or choose one, for its mass, material and file.";

const page = (id) => document.getElementById(id);
const text = (id) => page(id).textContent.trim();

function bytes(base64) {
  const raw = atob(base64);
  const out = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; i++) out[i] = raw.charCodeAt(i);
  return out.buffer;
}

function seeable() {
  const dark = window.matchMedia("(prefers-color-scheme: dark)").matches;
  return {
    background: new Color(dark ? 0x1c1f24 : 0xf4f6f8),
    grid: dark ? 0x3a4048 : 0xc4ccd4,
    shadow: dark ? 1 : 0.5, // how dark, of 1
  };
}

class Viewer {
  constructor(box, data, robot) {
    this.box = box;
    this.data = data;
    this.renderer = new WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    box.appendChild(this.renderer.domElement);
    this.hidden = new Set();
    this.name();
    this.scene = new Scene();
    this.camera = new PerspectiveCamera(35, 1, 0.01, 20);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.addEventListener("change", () => this.draw());
    this.controls.minDistance = 0.3 * data.size_m;
    this.controls.zoomToCursor = true;
    this.dress();
    this.take(robot);
    this.trace();
    this.reached = this.reach();
    this.at = 0;
    this.playing = this.following = false;
    this.connect();
    this.resize();
  }

  // Who cannot see the canvas hears what it shows and which keys move it.
  name() {
    const canvas = this.renderer.domElement;
    canvas.tabIndex = 0;
    canvas.setAttribute("role", "application");
    canvas.setAttribute("aria-label", `The robot in 3-D. ${this.box.dataset.keys}`);
  }

  // Ground, shadow and light.
  dress() {
    const seen = seeable();
    this.scene.background = seen.background;
    this.darkest = seen.shadow;
    this.shadow = this.disc();
    this.scene.add(this.ground(seen.grid), this.shadow, new AmbientLight(0xffffff, 1.4));
    for (const [x, y, z, strength] of [[1, -2, 3, 2.0], [-2, 1.5, 1, 0.8]]) {
      const light = new DirectionalLight(0xffffff, strength);
      light.position.set(x, y, z);
      this.scene.add(light);
    }
  }

  // Squares under the whole jump; short lines, since some renderers drop those that pass behind the eye.
  ground(color) {
    const cell = this.data.cell_m;
    const around = 10;
    const [[first, last], [right, left]] = [0, 2].map((axis) => {
      const places = this.data.com_m.map((com) => com[axis] || 0);
      return [Math.floor(Math.min(...places) / cell) - around, Math.ceil(Math.max(...places) / cell) + around];
    });
    const points = [];
    for (let i = first; i <= last; i++) {
      for (let j = right; j <= left; j++) {
        if (i < last) points.push(i * cell, j * cell, 0, (i + 1) * cell, j * cell, 0);
        if (j < left) points.push(i * cell, j * cell, 0, i * cell, (j + 1) * cell, 0);
      }
    }
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new Float32BufferAttribute(points, 3));
    return new LineSegments(geometry, new LineBasicMaterial({ color }));
  }

  // A round shadow, black in the middle and clear at its rim; just below the lines of the ground, which stay seen.
  disc() {
    const geometry = new CircleGeometry(1, 48);
    const colors = Array.from({ length: geometry.attributes.position.count }, (_, i) => [0, 0, 0, i ? 0 : 1]);
    geometry.setAttribute("color", new Float32BufferAttribute(colors.flat(), 4));
    const material = new MeshBasicMaterial({ vertexColors: true, transparent: true, depthWrite: false });
    const disc = new Mesh(geometry, material);
    disc.position.z = -0.0005;
    return disc;
  }

  // Put the shadow under the robot: the higher that is, the larger and paler.
  shade() {
    const box = new Box3().setFromObject(this.robot);
    const height = Math.max(box.min.z, 0) / this.data.size_m;
    this.shadow.position.x = (box.min.x + box.max.x) / 2;
    this.shadow.position.y = this.ball.position.y;
    this.shadow.scale.setScalar(SHADOW * this.data.size_m * (1 + 0.3 * height));
    this.shadow.material.opacity = this.darkest / (1 + 0.7 * height);
    this.box.dataset.shadow = this.shadow.material.opacity.toFixed(3);
  }

  // The nodes of the GLB file: frames of the bodies, with their parts below.
  take(robot) {
    this.robot = robot;
    this.scene.add(robot);
    robot.position.set(0, 0, 0);
    robot.quaternion.identity(); // the file has y up
    this.nodes = {};
    robot.traverse((node) => {
      const name = node.userData.name || node.name;
      if (name && !(name in this.nodes)) this.nodes[name] = node;
    });
    this.frames = Object.keys(this.data.frames).map((name) => [this.nodes[`${name}_frame`], this.data.frames[name]]);
    this.parts = Object.keys(this.data.parts).filter((name) => name in this.nodes);
    this.rest = {};
    for (const name of this.parts) this.rest[name] = this.nodes[name].position.clone();
    this.turning = this.data.turning
      .filter(({ node }) => node in this.nodes)
      .map(({ node, axis_m, per_cam }) => {
        const pivot = new Group();
        pivot.position.set(axis_m[0], 0, axis_m[1]);
        this.nodes[node].parent.add(pivot);
        pivot.add(this.nodes[node]);
        this.rest[node].sub(pivot.position);
        this.nodes[node].position.copy(this.rest[node]);
        return [pivot, per_cam];
      });
  }

  // The path of the centre of mass, and a ball that runs along it.
  trace() {
    const points = this.data.com_m.flatMap(([x, z, y = 0]) => [x, y, z]);
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new Float32BufferAttribute(points, 3));
    this.path = new Line(geometry, new LineBasicMaterial({ color: 0xd1495b }));
    this.ball = new Mesh(new SphereGeometry(0.003, 16, 12), new MeshBasicMaterial({ color: 0xd1495b }));
    this.path.renderOrder = this.ball.renderOrder = 1;
    this.path.material.depthTest = this.ball.material.depthTest = false;
    this.scene.add(this.path, this.ball);
  }

  // The corners of the boxes about the robot at all moments of its motion.
  reach() {
    return this.data.show_s.flatMap((_, index) => {
      this.place(index, index, 0);
      const { min, max } = new Box3().setFromObject(this.robot);
      const corners = Array.from({ length: 8 }, (_, i) => [i & 1, i & 2, i & 4]);
      return corners.map(([x, y, z]) => new Vector3((x ? max : min).x, (y ? max : min).y, (z ? max : min).z));
    });
  }

  // The first view: of the whole jump, or near the robot if the camera follows it.
  home() {
    if (this.following) this.near();
    else this.whole();
    this.controls.update();
    this.first = this.camera.position.clone();
  }

  near() {
    const [x, z, y = 0] = this.data.com_m[0];
    const far = 2.1 * this.data.size_m;
    this.controls.maxDistance = 12 * this.data.size_m;
    this.followed = [x, z, y];
    this.controls.target.set(x, y, 0.8 * z);
    this.camera.position.set(x + 0.75 * far, y - far, z + 0.5 * far);
    if (this.seen) this.follow(...this.seen);
  }

  // As near as all places of the robot permit. With right, up and depth as axes, a point (r, u, d) is in the picture
  // of a camera at (R, U, D) if |r - R| <= wide (d - D) and |u - U| <= high (d - D).
  whole() {
    const away = new Vector3(...FROM).normalize();
    const right = new Vector3(0, 0, 1).cross(away).normalize();
    const up = new Vector3().crossVectors(away, right);
    const high = FILLED * Math.tan((this.camera.fov * Math.PI) / 360);
    const depths = this.reached.map((point) => -point.dot(away));
    const fits = [[right, high * this.camera.aspect], [up, high]].map(([axis, slope]) => {
      const places = this.reached.map((point) => point.dot(axis));
      const least = Math.min(...places.map((place, i) => place + slope * depths[i]));
      const most = Math.max(...places.map((place, i) => place - slope * depths[i]));
      return { middle: (least + most) / 2, depth: (least - most) / (2 * slope) };
    });
    const depth = Math.min(...fits.map((fit) => fit.depth));
    const far = (Math.min(...depths) + Math.max(...depths)) / 2 - depth;
    this.controls.maxDistance = Math.max(12 * this.data.size_m, 3 * far);
    this.camera.position.set(0, 0, 0);
    this.camera.position.addScaledVector(right, fits[0].middle).addScaledVector(up, fits[1].middle);
    this.camera.position.addScaledVector(away, -depth);
    this.controls.target.copy(this.camera.position).addScaledVector(away, -far);
  }

  // Turn the camera about what it looks at, by angles to the left and up (rad).
  turn(left, up) {
    const away = new Vector3().subVectors(this.camera.position, this.controls.target);
    const flat = Math.hypot(away.x, away.y);
    const side = Math.atan2(away.y, away.x) - left;
    const rise = Math.min(Math.max(Math.atan2(away.z, flat) + up, -1.5), 1.5);
    const far = away.length();
    away.set(Math.cos(side) * Math.cos(rise), Math.sin(side) * Math.cos(rise), Math.sin(rise)).multiplyScalar(far);
    this.camera.position.copy(this.controls.target).add(away);
    this.controls.update();
  }

  // Move camera and what it looks at across the picture, in shares of the robot's size.
  move(right, up) {
    this.camera.updateMatrixWorld();
    for (const [axis, share] of [[0, right], [1, up]]) {
      const way = new Vector3().setFromMatrixColumn(this.camera.matrixWorld, axis);
      way.multiplyScalar(share * this.data.size_m);
      this.camera.position.add(way);
      this.controls.target.add(way);
    }
    this.controls.update();
  }

  zoom(factor) {
    this.camera.position.sub(this.controls.target).multiplyScalar(1 / factor).add(this.controls.target);
    this.controls.update();
  }

  // Do what a key on the canvas asks for; false if it asks for nothing.
  key({ key, shiftKey, ctrlKey, altKey, metaKey, repeat }) {
    if (ctrlKey || altKey || metaKey) return false;
    const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    if (key in arrows) {
      const [right, up] = arrows[key];
      if (shiftKey) this.move(-MOVE * right, -MOVE * up);
      else this.turn(TURN * right, TURN * up);
    } else if (key === "+" || key === "=") this.zoom(ZOOM);
    else if (key === "-" || key === "_") this.zoom(1 / ZOOM);
    else if (key === "0" || key === "Home") this.home();
    else if (key === " ") repeat || this.play(!this.playing); // a key held down plays or pauses once
    else if (key === "," || key === ".") {
      this.play(false);
      this.pose(this.at + (key === "." ? MOMENT_S : -MOMENT_S));
    } else return false;
    this.draw();
    return true;
  }

  // Move the camera with the robot.
  follow(x, z, y) {
    for (const point of [this.controls.target, this.camera.position]) {
      point.x += x - this.followed[0];
      point.y += y - this.followed[2];
      point.z += z - this.followed[1];
    }
    this.followed = [x, z, y];
  }

  // Put the bodies between two of their poses.
  place(low, high, share) {
    for (const [node, poses] of this.frames) {
      const [a, b] = [poses[low], poses[high]];
      node.position.set(...[0, 1, 2].map((axis) => a[axis] + share * (b[axis] - a[axis])));
      node.quaternion.set(a[3], a[4], a[5], a[6]).slerp(new Quaternion(b[3], b[4], b[5], b[6]), share);
    }
  }

  // Pose everything as at a moment of the shown time (s).
  pose(at) {
    const { show_s, cam_rad, com_m, time_s, phase } = this.data;
    this.at = Math.min(Math.max(at, 0), show_s[show_s.length - 1]);
    let low = 0;
    while (low < show_s.length - 2 && show_s[low + 1] <= this.at) low++;
    const share = (this.at - show_s[low]) / (show_s[low + 1] - show_s[low]);
    const mix = (a, b) => a + share * (b - a);
    this.place(low, low + 1, share);
    const cam = mix(cam_rad[low], cam_rad[low + 1]);
    const gear = mix(this.data.gear_rad[low], this.data.gear_rad[low + 1]);
    this.turning.forEach(([pivot, per_cam], index) => {
      pivot.rotation.y = per_cam * (this.data.turning[index].node === "cam" ? cam : gear);
    });
    const [x, z, y] = [0, 1, 2].map((axis) => mix(com_m[low][axis] || 0, com_m[low + 1][axis] || 0));
    this.ball.position.set(x, y, z);
    this.seen = [x, com_m[0][1] + RISING * Math.max(z - com_m[0][1], 0), y];
    if (this.following) this.follow(...this.seen);
    this.shade();
    page("scrub").value = this.at;
    const now = phase[share < 1 ? low : low + 1];
    const slow = this.data.phases[now];
    const moment = mix(time_s[low], time_s[low + 1]);
    const said = `${now}, ${moment.toFixed(moment < 1 ? 3 : 1)} s${slow}`;
    page("moment").textContent = said;
    page("scrub").setAttribute("aria-valuetext", said);
    this.box.dataset.phase = now;
    this.box.dataset.shown = this.at.toFixed(3);
    this.draw();
  }

  // Move the parts apart across the robot, by a share of the full way.
  explode(share) {
    for (const name of this.parts) {
      this.nodes[name].position.copy(this.rest[name]);
      this.nodes[name].position.y += share * (this.data.explode_m[name] || 0);
    }
    this.box.dataset.exploded = share;
    this.draw();
  }

  // Show what is there after a number of steps of assembly.
  step(count) {
    this.count = count;
    const all = count >= this.data.steps.length;
    const said = all ? "all parts" : `${count}. ${this.data.steps[count - 1].title}`;
    page("step-title").textContent = said;
    page("step").setAttribute("aria-valuetext", said);
    this.show();
  }

  // Show the parts that are there, but those of the kinds that are switched off.
  show() {
    const there = new Set(this.data.steps.slice(0, this.count).flatMap((step) => step.parts));
    const all = this.count >= this.data.steps.length;
    let shown = 0;
    for (const name of this.parts) {
      const visible = (all || there.has(name)) && !this.hidden.has(this.kind(name));
      this.nodes[name].visible = visible;
      shown += visible ? 1 : 0;
    }
    this.path.visible = this.ball.visible = all && !this.hidden.has("path");
    this.box.dataset.parts = shown;
    this.draw();
  }

  kind(name) {
    if (!this.data.parts[name].file) return "bought";
    return name.startsWith("body_plate") ? "plates" : "printed";
  }

  pick(event) {
    const area = this.renderer.domElement.getBoundingClientRect();
    const at = new Vector2(
      (2 * (event.clientX - area.left)) / area.width - 1,
      1 - (2 * (event.clientY - area.top)) / area.height,
    );
    const ray = new Raycaster();
    ray.setFromCamera(at, this.camera);
    const shown = this.parts.map((name) => this.nodes[name]).filter((node) => node.visible);
    const hit = ray.intersectObjects(shown, true)[0];
    let node = hit && hit.object;
    while (node && !(this.data.parts[node.userData.name || node.name])) node = node.parent;
    this.select(node ? node.userData.name || node.name : "");
  }

  select(name) {
    for (const [node, material] of this.lit || []) node.material = material;
    this.lit = [];
    const part = this.data.parts[name];
    if (part) {
      this.nodes[name].traverse((node) => {
        if (!node.isMesh) return;
        this.lit.push([node, node.material]);
        node.material = node.material.clone();
        node.material.color = new Color(0xffb000);
        node.material.emissive = new Color(0x442200);
      });
    }
    page("choose").value = name;
    page("part").textContent = part
      ? `${part.label}: ${part.mass_g.toFixed(2)} g, ${part.material}${part.file ? ", " : ""}`
      : HINT;
    if (part && part.file) page("part").append(this.link(part.file));
    this.box.dataset.part = name;
    this.draw();
  }

  // A part's file: a link where the page has one, among those to the files beside it.
  link(file) {
    const there = [...document.links].find((link) => link.getAttribute("href") === file);
    if (!there) return file;
    const link = document.createElement("a");
    link.href = file;
    link.textContent = file;
    return link;
  }

  play(on) {
    const end = this.data.show_s[this.data.show_s.length - 1];
    if (on && this.at >= end) this.pose(0);
    this.playing = on;
    page("play").textContent = on ? "Pause" : "Play";
    this.box.dataset.playing = on;
    cancelAnimationFrame(this.coming);
    let last = null;
    const next = (now) => {
      this.pose(this.at + (last === null ? 0 : Math.min((now - last) / 1000, LONGEST_S)));
      last = now;
      if (this.at >= end) this.play(false);
      else this.coming = requestAnimationFrame(next);
    };
    if (on) this.coming = requestAnimationFrame(next);
  }

  connect() {
    const scrub = page("scrub");
    scrub.max = this.data.show_s[this.data.show_s.length - 1];
    scrub.addEventListener("input", () => {
      this.play(false);
      this.pose(Number(scrub.value));
    });
    page("play").addEventListener("click", () => this.play(!this.playing));
    page("home").addEventListener("click", () => {
      this.home();
      this.draw();
    });
    page("explode").addEventListener("input", (event) => this.explode(Number(event.target.value)));
    const steps = page("step");
    steps.max = this.data.steps.length;
    steps.value = this.data.steps.length;
    steps.addEventListener("input", () => this.step(Number(steps.value)));
    for (const kind of ["plates", "printed", "bought", "path"]) {
      const box = page(`show-${kind}`);
      box.addEventListener("change", () => {
        this.hidden[box.checked ? "delete" : "add"](kind);
        this.show();
      });
    }
    const follow = page("follow");
    follow.checked = false; // some browsers keep it when the page is loaded again
    follow.addEventListener("change", () => {
      this.following = follow.checked;
      this.home();
      this.draw();
    });
    const choose = page("choose");
    const label = (name) => this.data.parts[name].label;
    for (const name of [...this.parts].sort((one, other) => label(one).localeCompare(label(other), "en"))) {
      choose.add(new Option(label(name), name));
    }
    choose.addEventListener("change", () => this.select(choose.value));
    let pressed = null;
    const canvas = this.renderer.domElement;
    canvas.addEventListener("keydown", (event) => {
      if (this.key(event)) event.preventDefault();
    });
    canvas.addEventListener("pointerdown", (event) => (pressed = [event.clientX, event.clientY]));
    canvas.addEventListener("pointerup", (event) => {
      if (pressed && Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) < 4) this.pick(event);
    });
    window.addEventListener("resize", () => this.resize());
  }

  resize() {
    const width = this.box.clientWidth;
    const height = Math.max(260, Math.min(Math.round(0.62 * width), 560));
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    if (!this.first || this.camera.position.equals(this.first)) this.home();
    this.draw();
  }

  draw() {
    this.renderer.render(this.scene, this.camera);
    this.box.dataset.camera = this.camera.position.toArray().map((place) => place.toFixed(4));
  }
}

function start() {
  const box = page("viewer");
  const failed = (reason) => {
    page("viewer-message").textContent =
      `The robot cannot be shown in 3-D here (${reason}). All figures below and the pictures are complete without it.`;
    page("viewer-controls").hidden = page("viewer-keys").hidden = true;
    box.dataset.state = "failed";
  };
  if (!window.WebGLRenderingContext) {
    failed("this browser has no WebGL");
    return;
  }
  const data = JSON.parse(text("viewer-data"));
  new GLTFLoader().parse(
    bytes(text("viewer-glb")),
    "",
    (gltf) => {
      try {
        const robot = gltf.scene.getObjectByName("robot") || gltf.scene;
        const viewer = new Viewer(box, data, robot);
        viewer.step(data.steps.length);
        viewer.select("");
        viewer.pose(0);
        page("viewer-message").textContent = "";
        page("viewer-controls").hidden = page("viewer-keys").hidden = false;
        box.dataset.state = "ready";
      } catch (error) {
        failed("WebGL did not start");
      }
    },
    () => failed("its file could not be read"),
  );
}

start();
