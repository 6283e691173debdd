// Bundles three_parts.js, with the licence on top, into three.min.js.
import {readFileSync} from "node:fs";
import {build} from "esbuild";

const {version} = JSON.parse(readFileSync("node_modules/three/package.json"));
await build({
  entryPoints: ["three_parts.js"], outfile: "three.min.js", bundle: true, minify: true, format: "iife", globalName: "THREE",
  target: "es2020", legalComments: "none",
  banner: {js: `/*! three.js ${version}\n${readFileSync("node_modules/three/LICENSE", "utf8").trim()}\n*/`},
});
