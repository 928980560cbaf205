// The picture of triangles and lines in space, and where a ray meets them. The only file that knows vtk.js.
import "@kitware/vtk.js/Rendering/OpenGL/Profiles/Geometry.js";
import vtkActor from "@kitware/vtk.js/Rendering/Core/Actor.js";
import vtkDataArray from "@kitware/vtk.js/Common/Core/DataArray.js";
import vtkInteractorStyle from "@kitware/vtk.js/Interaction/Style/InteractorStyleTrackballCamera.js";
import vtkMapper from "@kitware/vtk.js/Rendering/Core/Mapper.js";
import vtkOpenGLRenderWindow from "@kitware/vtk.js/Rendering/OpenGL/RenderWindow.js";
import vtkPolyData from "@kitware/vtk.js/Common/DataModel/PolyData.js";
import vtkRenderer from "@kitware/vtk.js/Rendering/Core/Renderer.js";
import vtkRenderWindow from "@kitware/vtk.js/Rendering/Core/RenderWindow.js";
import vtkRenderWindowInteractor from "@kitware/vtk.js/Rendering/Core/RenderWindowInteractor.js";
import { on_size } from "./elements.js";

const rgb = (text) => [1, 3, 5].map((i) => parseInt(text.slice(i, i + 2), 16) / 255);

function layer(renderer) {
  const actor = vtkActor.newInstance();
  const mapper = vtkMapper.newInstance();
  actor.setMapper(mapper);
  actor.setVisibility(false);
  renderer.addActor(actor);
  return { actor, mapper };
}

/** One picture that is drawn anew on request. */
export class Scene {
  /** Throws if the browser has no WebGL. */
  constructor(holder) {
    this.holder = holder;
    this.renderer = vtkRenderer.newInstance();
    this.window = vtkRenderWindow.newInstance();
    this.window.addRenderer(this.renderer);
    this.view = vtkOpenGLRenderWindow.newInstance();
    const canvas = this.view.getCanvas();
    const kept = { preserveDrawingBuffer: true, depth: true, alpha: true }; // for the printer
    if (!canvas.getContext("webgl2", kept)) throw new Error("this browser has no WebGL 2");
    this.window.addView(this.view);
    this.view.setContainer(holder);
    this.interactor = vtkRenderWindowInteractor.newInstance();
    this.interactor.setView(this.view);
    this.interactor.initialize();
    this.interactor.setInteractorStyle(vtkInteractorStyle.newInstance());
    // The wheel scrolls the page unless the picture has the focus.
    holder.addEventListener("wheel", (e) => document.activeElement !== holder && e.stopPropagation(), {
      capture: true,
    });
    this.interactor.bindEvents(holder);
    holder.addEventListener("pointerdown", () => holder.focus({ preventScroll: true }), { capture: true });

    this.surface = layer(this.renderer);
    this.surface.mapper.setColorModeToDirectScalars();
    this.surface.mapper.setScalarModeToUsePointData();
    this.surface.actor.getProperty().setInterpolationToFlat();
    this.surface.actor.getProperty().set({ ambient: 0.5, diffuse: 0.55, specular: 0 });
    this.surface.mapper.setResolveCoincidentTopologyToPolygonOffset();
    this.surface.mapper.setRelativeCoincidentTopologyPolygonOffsetParameters(1, 1);
    this.lines = layer(this.renderer);
    this.lines.mapper.setScalarVisibility(false);
    this.borders = layer(this.renderer);
    this.borders.mapper.setScalarVisibility(false);
    this.borders.actor.getProperty().setLineWidth(2);
    for (const { actor } of [this.lines, this.borders]) actor.getProperty().setLighting(false);
    on_size(holder, () => this.resize());
    this.resize();
  }

  resize() {
    const { width, height } = this.holder.getBoundingClientRect();
    const ratio = Math.min(2, window.devicePixelRatio || 1);
    this.view.setSize(Math.max(1, Math.round(width * ratio)), Math.max(1, Math.round(height * ratio)));
    this.window.render();
  }

  /** Colours as "#rrggbb". */
  paint(ground, ink, faint) {
    this.renderer.setBackground(...rgb(ground));
    this.borders.actor.getProperty().setColor(...rgb(ink));
    this.lines.actor.getProperty().setColor(...rgb(faint));
    this.window.render();
  }

  /** Triangles: nine coordinates and nine bytes of colour each; lines: six coordinates each. */
  show({ points, colours, lines, borders }) {
    const surface = vtkPolyData.newInstance();
    const n = points.length / 3;
    surface.getPoints().setData(points, 3);
    const cells = new Uint32Array((4 * n) / 3);
    for (let i = 0, k = 0; i < n;) {
      cells[k++] = 3;
      cells[k++] = i++;
      cells[k++] = i++;
      cells[k++] = i++;
    }
    surface.getPolys().setData(cells);
    surface
      .getPointData()
      .setScalars(vtkDataArray.newInstance({ name: "colour", numberOfComponents: 3, values: colours }));
    this.points = points;
    this.surface.mapper.setInputData(surface);
    this.surface.actor.setVisibility(n > 0);
    this.draw_lines(this.lines, lines);
    this.draw_lines(this.borders, borders);
    this.renderer.resetCameraClippingRange();
    this.window.render();
  }

  draw_lines({ actor, mapper }, ends) {
    actor.setVisibility(ends.length > 0);
    if (ends.length === 0) return;
    const data = vtkPolyData.newInstance();
    data.getPoints().setData(ends, 3);
    const cells = new Uint32Array(ends.length / 2);
    for (let i = 0, k = 0; k < cells.length;) {
      cells[k++] = 2;
      cells[k++] = i++;
      cells[k++] = i++;
    }
    data.getLines().setData(cells);
    mapper.setInputData(data);
  }

  /** From the next picture on: at the middle from `direction`, `up` upwards; `half`: half the height that is seen. */
  look(middle, direction, up, distance, half) {
    this.home = { middle, half };
    const camera = this.renderer.getActiveCamera();
    camera.setFocalPoint(...middle);
    camera.setPosition(...middle.map((c, i) => c + distance * direction[i]));
    camera.setViewUp(...up);
    camera.setParallelProjection(true);
    camera.setParallelScale(half);
    this.renderer.updateLightsGeometryToFollowCamera();
  }

  /** Calls `act` after the camera has moved, once for all that moves it before the next picture. */
  on_camera(act) {
    let waits = false;
    this.renderer.getActiveCamera().onModified(() => {
      if (waits) return;
      waits = true;
      requestAnimationFrame(() => ((waits = false), act()));
    });
  }

  /** Sees its body as another scene sees its own; nothing where it does already. */
  see_as(other) {
    const from = other.renderer.getActiveCamera();
    const camera = this.renderer.getActiveCamera();
    const ratio = this.home.half / other.home.half;
    const focal = from.getFocalPoint();
    const here = this.home.middle.map((c, i) => c + ratio * (focal[i] - other.home.middle[i]));
    const place = from.getPosition().map((c, i) => here[i] + ratio * (c - focal[i]));
    const scale = ratio * from.getParallelScale();
    const up = from.getViewUp();
    const now = [...camera.getFocalPoint(), ...camera.getPosition(), ...camera.getViewUp(), camera.getParallelScale()];
    const size = Math.hypot(...place.map((c, i) => c - here[i]));
    const same = [...here, ...place].every((v, i) => Math.abs(v - now[i]) < 1e-6 * size);
    if (same && up.every((v, i) => Math.abs(v - now[6 + i]) < 1e-6) && Math.abs(scale / now[9] - 1) < 1e-6) return;
    camera.setFocalPoint(...here);
    camera.setPosition(...place);
    camera.setViewUp(...up);
    camera.setParallelScale(scale);
    this.renderer.resetCameraClippingRange();
    this.renderer.updateLightsGeometryToFollowCamera();
    this.window.render();
  }

  turn(azimuth, elevation) {
    const camera = this.renderer.getActiveCamera();
    camera.azimuth(azimuth);
    camera.elevation(elevation);
    camera.orthogonalizeViewUp();
    this.renderer.resetCameraClippingRange();
    this.renderer.updateLightsGeometryToFollowCamera();
    this.window.render();
  }

  zoom(factor) {
    const camera = this.renderer.getActiveCamera();
    camera.setParallelScale(camera.getParallelScale() / factor);
    this.window.render();
  }

  /** The nearest triangle under a place of the holder (from its upper left corner, in CSS pixels), or -1. */
  pick(left, top) {
    if (!this.points) return -1;
    const { width, height } = this.holder.getBoundingClientRect();
    const [w, h] = this.view.getSize();
    const at = (z) => this.view.displayToWorld((left / width) * w, (1 - top / height) * h, z, this.renderer);
    const from = at(0);
    const to = at(1);
    const d = to.map((v, i) => v - from[i]);
    const p = this.points;
    let best = Infinity;
    let found = -1;
    for (let i = 0; i < p.length; i += 9) {
      const ax = p[i + 3] - p[i],
        ay = p[i + 4] - p[i + 1],
        az = p[i + 5] - p[i + 2];
      const bx = p[i + 6] - p[i],
        by = p[i + 7] - p[i + 1],
        bz = p[i + 8] - p[i + 2];
      const nx = d[1] * bz - d[2] * by,
        ny = d[2] * bx - d[0] * bz,
        nz = d[0] * by - d[1] * bx;
      const det = ax * nx + ay * ny + az * nz;
      if (det === 0) continue;
      const sx = from[0] - p[i],
        sy = from[1] - p[i + 1],
        sz = from[2] - p[i + 2];
      const u = (sx * nx + sy * ny + sz * nz) / det;
      if (u < 0 || u > 1) continue;
      const qx = sy * az - sz * ay,
        qy = sz * ax - sx * az,
        qz = sx * ay - sy * ax;
      const v = (d[0] * qx + d[1] * qy + d[2] * qz) / det;
      if (v < 0 || u + v > 1) continue;
      const t = (bx * qx + by * qy + bz * qz) / det;
      if (t > 0 && t < best) [best, found] = [t, i / 9];
    }
    return found;
  }

  picture() {
    this.window.render();
    return this.view.getCanvas();
  }
}
