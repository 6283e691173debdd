"""report_page.py PAGE CLUSTER.h5 [FOLDER]: opens pigment-report's page from disk and uses it as a reader would. Ends with status 1 and a
message where it does not answer. FOLDER: where screenshots are kept.
"""
import os
import sys

import chromium
import h5py

DIFFERENCE = """async (one, two) => {
  const pixels = async data => {
    const image = new Image();
    image.src = 'data:image/png;base64,' + data;
    await image.decode();
    const canvas = document.createElement('canvas');
    canvas.width = image.width, canvas.height = image.height;
    const context = canvas.getContext('2d', {willReadFrequently: true});
    context.drawImage(image, 0, 0);
    return context.getImageData(0, 0, image.width, image.height).data;
  };
  const [a, b] = [await pixels(one), await pixels(two)];
  let different = 0;
  for (let i = 0; i < a.length; i += 4)
    if (Math.abs(a[i] - b[i]) + Math.abs(a[i + 1] - b[i + 1]) + Math.abs(a[i + 2] - b[i + 2]) > 24) ++different;
  return different / (a.length / 4);
}"""


def check(claim, value=True):
    if not value:
        sys.exit("not so: " + claim)


class Reader:
    def __init__(self, page, folder):
        self.page, self.folder = page, folder
        self.last = None

    def wait_until_drawn(self):
        """Until the fine drawing, which comes when nothing has changed for a while, is on the screen."""
        self.page.wait("document.querySelector('figure.viewer').viewer.settled_at === document.querySelector('figure.viewer').viewer.changed_at")
        self.page.evaluate("new Promise(go => requestAnimationFrame(() => requestAnimationFrame(go)))")

    def picture(self, name):
        self.wait_until_drawn()
        box = self.page.evaluate("""(() => {
          document.querySelector('.viewer .stage').scrollIntoView({block: 'center', behavior: 'instant'});
          const b = document.querySelector('.viewer .stage').getBoundingClientRect();
          return {x: b.x + scrollX, y: b.y + scrollY, width: b.width, height: b.height};
        })()""")
        return self.page.screenshot(self.folder and os.path.join(self.folder, name + ".png"), box)

    def changed(self, name, least):
        """The view differs from the one before in at least this share of its pixels."""
        now = self.picture(name)
        if self.last is not None:
            share = self.page.evaluate(f"({DIFFERENCE})({self.last!r}, {now!r})")
            check(f"{name}: {100 * share:.2f} % of the view changed, at least {100 * least} % should", share >= least)
        self.last = now

    def set(self, selector, value, event="input"):
        self.page.evaluate(f"""(() => {{
          const e = document.querySelector({selector!r});
          if (e.type === 'checkbox') e.checked = {str(bool(value)).lower()}; else e.value = {str(value)!r};
          e.dispatchEvent(new Event({event!r}, {{bubbles: true}}));
        }})()""")


def with_webgl(file, folder, dark):
    with chromium.Chromium(dark=dark) as browser:
        page = browser.open(file)
        page.wait("document.querySelector('figure.viewer').dataset.ready === 'yes'")
        reader = Reader(page, folder)
        text = lambda selector: page.evaluate(f"document.querySelector({selector!r}).textContent")
        reader.changed("start-dark" if dark else "start", 0)
        if dark:
            check("the view is dark", page.evaluate("getComputedStyle(document.querySelector('.stage')).backgroundColor") == "rgb(16, 20, 26)")
            check("complaints: " + "; ".join(page.complaints()), not page.complaints())
            return

        # Clusters as pigment-cluster finds them. Places are rounded, by less than a nanometre here, so pairs whose separation
        # lies that near to the threshold may count here and not there: about one in a hundred.
        for k, (connections, clustered) in enumerate(EXPECTED):
            found = page.evaluate(f"(c => [c.first.length, c.clustered])(document.querySelector('figure.viewer').viewer.runs[0].clusters({k}, 0.02))")
            check(f"frame {k}: {found} connections and clustered particles, {[connections, clustered]} in the file",
                  abs(found[0] - connections) <= 2 + 0.02 * connections and abs(found[1] - clustered) <= 2 + 0.02 * clustered)

        # Time: the slider moves the view, the profiles and the line in the curves.
        profile = "document.querySelector('figure.plot .current .line').getAttribute('d')"
        before = page.evaluate(profile), text(".viewer label.slider output")
        reader.set(".viewer [data-is=time]", 0)
        check("the profile follows the view's slider", page.evaluate(profile) != before[0])
        check("so does the time shown", text(".viewer label.slider output") != before[1])
        check("curves against time show it", page.evaluate("document.querySelector('svg .now').getAttribute('d') !== ''"))
        check("and one of the pictures", page.evaluate("document.querySelectorAll('.pictures .now').length") == 1)
        reader.changed("time", 0.01)
        reader.set("figure.plot .slider input", 2)
        check("the view follows a profile's slider", page.evaluate("document.querySelector('.viewer [data-is=time]').value") == "2")
        reader.changed("profile-slider", 0.005)

        by_size = reader.last
        for colour in page.evaluate("[...document.querySelectorAll('[data-is=colour] option')].map(o => o.value)"):
            if colour != "size":
                reader.set(".viewer [data-is=colour]", colour, "change")
                reader.last = by_size
                reader.changed("colour-" + colour, 0.005)
        reader.set(".viewer [data-is=connections]", True)
        reader.set(".viewer [data-is=scale]", 0.4)
        reader.changed("connections", 0.02)
        reader.set(".viewer [data-is=clusters_only]", True)
        reader.changed("clusters-only", 0.0003)
        shown = page.evaluate("document.querySelector('figure.viewer').viewer.layers[0].radius.array.filter(r => r > 0).length")
        check(f"{shown} particles are drawn, those of clusters: " + text(".viewer .found"), f" {shown} of 300 particles in them" in text(".viewer .found"))
        check("which are not all", 0 < shown < 300)
        reader.set(".viewer [data-is=clusters_only]", False)
        reader.set(".viewer [data-is=connections]", False)
        reader.set(".viewer [data-is=scale]", 1)
        reader.set(".viewer [data-is=colour]", "size", "change")
        reader.changed("spheres", 0.02)
        reader.set(".viewer [data-cut=y0]", 500)
        reader.changed("cut", 0.005)
        reader.set(".viewer [data-cut=y0]", 0)
        reader.changed("uncut", 0.005)

        # Dragging turns the view; a click on a particle tells its numbers.
        box = page.evaluate("(() => { const b = document.querySelector('.viewer canvas').getBoundingClientRect(); return [b.x, b.y, b.width, b.height]; })()")
        x, y = box[0] + box[2] / 2, box[1] + box[3] / 2
        page.mouse("mousePressed", x, y)
        for step in range(1, 6):
            page.mouse("mouseMoved", x + 30 * step, y + 8 * step, buttons=1)
        page.mouse("mouseReleased", x + 150, y + 40)
        reader.changed("turned", 0.02)
        target = page.evaluate("""(() => {  // the middle of a sphere that is seen
          const v = document.querySelector('figure.viewer').viewer, pane = v.panes()[0], layer = v.layers[pane.r];
          for (let i = 0; i < layer.data.count; ++i) {
            const p = new THREE.Vector3(...layer.centre.array.slice(3 * i, 3 * i + 3)), away = p.clone().sub(v.camera.position).normalize();
            if (layer.hit(v.camera.position, away) !== i) continue;
            const s = p.project(v.camera), b = v.canvas.getBoundingClientRect();
            return {i, id: layer.data.id[i], diameter: 2 * layer.data.radius[i], x: b.x + pane.x + (s.x + 1) / 2 * pane.w, y: b.bottom - pane.y - (s.y + 1) / 2 * pane.h};
          }
        })()""")
        page.mouse("mousePressed", target["x"], target["y"])
        page.mouse("mouseReleased", target["x"], target["y"])
        shown = dict(zip(*[iter(page.evaluate("[...document.querySelectorAll('.picked > *')].map(e => e.textContent)"))] * 2))
        check(f"the picked particle is {target}: {shown}", shown.get("particle") == str(int(target["id"])))
        check(f"its numbers: {shown}", {"diameter", "position", "velocity", "speed", "cluster"} <= set(shown))
        reader.changed("picked", 0.0002)

        # A plot: zoom by dragging, back by its button; a name in the legend switches its curve.
        zoomed = page.evaluate("""(() => {
          const f = document.querySelector('figure.plot'), svg = f.querySelector('svg');
          svg.scrollIntoView({block: 'center', behavior: 'instant'});
          const b = svg.getBoundingClientRect();
          return {x: b.x + b.width * 0.3, y: b.y + b.height * 0.2, w: b.width * 0.3, h: b.height * 0.4};
        })()""")
        ticks = lambda: page.evaluate("[...document.querySelector('figure.plot .ticks').querySelectorAll('text')].map(t => t.textContent).join()")
        whole = ticks()
        page.mouse("mousePressed", zoomed["x"], zoomed["y"])
        page.mouse("mouseMoved", zoomed["x"] + zoomed["w"], zoomed["y"] + zoomed["h"], buttons=1)
        page.mouse("mouseReleased", zoomed["x"] + zoomed["w"], zoomed["y"] + zoomed["h"])
        check("zooming changes the numbers at the axes", ticks() != whole)
        page.mouse("mouseMoved", zoomed["x"] + 20, zoomed["y"] + 20)
        check("pointing shows values", page.evaluate("!document.querySelector('figure.plot .tip').hidden"))
        if folder:
            page.screenshot(os.path.join(folder, "zoomed.png"))
        page.evaluate("document.querySelector('figure.plot .unzoom').click()")
        check("and back", page.evaluate("document.querySelector('figure.plot .unzoom').hidden"))
        check("the legend switches a curve", page.evaluate("""(() => {
          const key = document.querySelector('figure.plot .key');
          key.click();
          return key.getAttribute('aria-pressed') === 'false' && document.querySelectorAll('figure.plot .series.off').length === 1;
        })()"""))
        check("complaints: " + "; ".join(page.complaints()), not page.complaints())


def without_webgl(file, folder):
    with chromium.Chromium(webgl=False) as browser:
        page = browser.open(file)
        page.wait("!document.querySelector('figure.viewer').hidden")
        check("it says that WebGL is missing", "WebGL" in page.evaluate("document.querySelector('.viewer-missing').innerText"))
        check("the pictures are there", page.evaluate("[...document.querySelectorAll('.pictures img')].filter(i => i.complete && i.naturalWidth > 0).length >= 4"))
        check("and no controls", page.evaluate("document.querySelectorAll('.viewer select').length") == 0)
        if folder:
            page.evaluate("document.querySelector('figure.viewer').scrollIntoView({block: 'center', behavior: 'instant'})")
            page.screenshot(os.path.join(folder, "no-webgl.png"))
        check("complaints: " + "; ".join(page.complaints()), not page.complaints())


file, folder = sys.argv[1], sys.argv[3] if len(sys.argv) > 3 else None
with h5py.File(sys.argv[2]) as f:
    EXPECTED = [(int(c), round(float(share) * f["cluster/size"].shape[1]))
                for c, share in zip(f["cluster/connections"], f["cluster/clustered_fraction"])]
if folder:
    os.makedirs(folder, exist_ok=True)
with_webgl(file, folder, dark=False)
with_webgl(file, folder, dark=True)
without_webgl(file, folder)
