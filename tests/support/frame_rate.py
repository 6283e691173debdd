"""frame_rate.py PAGE: pictures a second of the 3-D view in a page of pigment-report, turning all the time, in Chromium with
whatever draws on this machine (named; without a graphics card that is the processor).
"""
import sys

import chromium

with chromium.Chromium(graphics="any") as browser:
    page = browser.open(sys.argv[1])
    page.wait("document.querySelector('figure.viewer').dataset.ready === 'yes'", 120)
    print(page.evaluate("""(async () => {
      const v = document.querySelector('figure.viewer').viewer, gl = v.renderer.getContext(), pixel = new Uint8Array(4);
      const name = gl.getExtension('WEBGL_debug_renderer_info');
      const centre = v.controls.target, away = v.camera.position.clone().sub(centre), axis = new THREE.Vector3(0, 0, 1);
      let pictures = 0;
      const start = performance.now();
      while (performance.now() - start < 5000) {
        const begun = performance.now();
        away.applyAxisAngle(axis, 0.05);
        v.camera.position.copy(centre).add(away);
        v.camera.lookAt(centre);
        v.draw(v.coarseness);
        gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);  // waits until it is drawn
        ++pictures;
        const took = performance.now() - begun;   // as the page itself does while the view is dragged
        v.coarseness = Math.min(1, Math.max(0.25, v.coarseness * (took > 70 ? 0.75 : took < 25 ? 1.2 : 1)));
      }
      const seconds = (performance.now() - start) / 1000, particles = v.runs.reduce((sum, d) => sum + d.count, 0);
      return `${(pictures / seconds).toFixed(1)} pictures a second: ${particles} particles, ${v.canvas.width} x ${v.canvas.height} pixels, ` +
        (name ? gl.getParameter(name.UNMASKED_RENDERER_WEBGL) : 'unnamed renderer');
    })()"""))
