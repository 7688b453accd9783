// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Results of all kinds, small but real, made by the treadmark program in a folder.
import { spawn, spawnSync } from "node:child_process";
import { cpSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

export class Results {
  constructor(program, examples, folder) {
    this.program = program;
    this.folder = folder;
    this.examples = join(folder, "inputs");
    cpSync(examples, this.examples, { recursive: true });
  }

  path(name) {
    return join(this.folder, name);
  }

  /** Runs the program; statuses: those that are right. */
  treadmark(args, statuses = [0]) {
    const done = spawnSync(this.program, ["--quiet", ...args], { encoding: "utf8", maxBuffer: 1 << 28 });
    if (!statuses.includes(done.status)) throw new Error(`treadmark ${args.join(" ")} ended with ${done.status}\n${done.stderr}`);
    return done;
  }

  /** The input of an example with other words in it. */
  input(name, example, changes) {
    let text = readFileSync(join(this.examples, example), "utf8");
    for (const [from, to] of changes) {
      if (!text.includes(from)) throw new Error(`${example} has no "${from}"`);
      text = text.replace(from, to);
    }
    const file = join(this.examples, name);
    writeFileSync(file, text);
    return file;
  }

  /** 26 positions of a wheel with a flat. */
  run() {
    const pitches = Array.from({ length: 26 }, (_, k) => k - 12.5).join(", ");
    const input = this.input("flat-26.toml", "wheel-flat.toml", [["[-14, -10, -8, -6, -4, -2, 0, 2, 4, 6, 8, 10, 14]", `[${pitches}]`]]);
    this.treadmark(["run", input, "-o", this.path("run"), "--report", this.path("run.html")]);
    return "run.html";
  }

  /** The same positions with less of a flat and more friction, laid over the first run. */
  overlay() {
    const input = this.input("flat-26-less.toml", "flat-26.toml", [["depth_mm = 1.4", "depth_mm = 1.2"], ["coefficient = 0.3", "coefficient = 0.4"]]);
    this.treadmark(["run", input, "-o", this.path("less-of-a-flat-and-more-friction")]);
    this.treadmark(["report", this.path("run"), this.path("less-of-a-flat-and-more-friction"), "-o", this.path("overlay.html")]);
    return "overlay.html";
  }

  /** 400 steps over 26 cases. */
  overlayLong() {
    this.treadmark(["report", this.path("run"), this.path("long"), "-o", this.path("overlay-long.html")]);
    return "overlay-long.html";
  }

  overlaySimulations() {
    this.treadmark(["simulate", join(this.examples, "short.toml"), "-o", this.path("faster"), "--set", "simulation.speed_m_s=45"]);
    this.treadmark(["report", this.path("simulation"), this.path("faster"), "-o", this.path("overlay-simulations.html")]);
    return "overlay-simulations.html";
  }

  /** 400 steps in time. */
  long() {
    this.treadmark(["run", join(this.examples, "rolling-flat.toml"), "-o", this.path("long"), "--report", this.path("long.html")]);
    return "long.html";
  }

  /** The same steps, stopped by Ctrl-C when some are done. */
  async interrupted() {
    const steps = this.input("many-steps.toml", "wheel-flat.toml", [["[-14, -10, -8, -6, -4, -2, 0, 2, 4, 6, 8, 10, 14]", `[${Array.from({ length: 3000 }, (_, k) => (k % 300) / 100).join(", ")}]`]]);
    const child = spawn(this.program, ["--quiet", "--threads", "1", "run", steps, "-o", this.path("interrupted"), "--report", this.path("interrupted.html"), "--set", "discretisation.dx_mm=1", "--set", "discretisation.ds_mm=1"], { stdio: "ignore" });
    const ended = new Promise((resolve) => child.on("exit", resolve));
    await new Promise((resolve) => setTimeout(resolve, 3000));
    child.kill("SIGINT");
    const status = await ended;
    if (status !== 1) throw new Error(`an interrupted run ended with ${status}`);
    return "interrupted.html";
  }

  /** Names and messages with markup: they must stay text. One case has no contact, one fails. */
  nasty() {
    const input = this.input("<img src=x onerror=alert(1)> & 'q'.toml", "wheel-flat.toml", [
      ["wheelset.pitch_deg = [-14, -10, -8, -6, -4, -2, 0, 2, 4, 6, 8, 10, 14]", "wheelset.pitch_deg = [0, 3]\n\n[[cases]]\nwheelset.y_mm = 300"],
      ["dx_mm = 0.5", "dx_mm = 1"],
      ['title = "Rounded wheel flat on 60E1"', "title = \"<img src=y onerror=alert(1)> & 'q'\""],
    ]);
    this.treadmark(["run", input, "-o", this.path("nasty")], [0, 1, 4]);
    this.treadmark(["report", this.path("nasty"), "-o", this.path("nasty.html")]);
    return "nasty.html";
  }

  compare() {
    const input = this.input("flat-3.toml", "wheel-flat.toml", [["[-14, -10, -8, -6, -4, -2, 0, 2, 4, 6, 8, 10, 14]", "[-8, 0, 5]"]]);
    this.treadmark(["compare", input, "--backends", "spline,mesh", "--resolutions", "1,0.5", "-o", this.path("compare"), "--report", this.path("compare.html")]);
    return "compare.html";
  }

  bench() {
    this.treadmark(["bench", "--resolutions", "1", "--seconds-per-measure", "0.01", "-o", this.path("bench"), "--report", this.path("bench.html")], [0]);
    return "bench.html";
  }

  import() {
    const flat = join(this.examples, "wheel-flat.toml");
    this.treadmark(["scan", flat, "-o", this.path("scan.ply"), "--body", "wheel", "--range-deg", "-90,90", "--points", "150000", "--noise-mm", "0.02", "--outliers", "0.002", "--seed", "5", "--truth", this.path("scan.json")]);
    this.treadmark(["import", this.path("scan.ply"), "-o", this.path("imported.slcw"), "--body", "wheel", "--nominal", "S1002", "--nominal-radius", "490", "--truth", this.path("scan.json"), "--report", this.path("import")]);
    return join("import", "report.html");
  }

  simulation() {
    const input = this.input("short.toml", "flat-at-speed.toml", [
      ["distance_m = 6.7", "distance_m = 0.7"],
      ['regime = "transient"', 'regime = "steady"'],
      ["dx_mm = 0.5", "dx_mm = 1"],
      ["ds_mm = 0.5", "ds_mm = 1"],
      ["[case]", "[simulation.fields]\npitch_deg = [-4, 0, 4]\n\n[case]"],
    ]);
    this.treadmark(["simulate", input, "--vtk", "-o", this.path("simulation"), "--report", this.path("simulation.html")]);
    return "simulation.html";
  }

  /** Pages without steps: geometry, measures, a check, an assessment of the simulation. */
  small() {
    const wheel = this.path("wheel.csv");
    this.treadmark(["geometry", "--wheel", "S1002", "--rail", "60E1", "--gauge-mm", "1435", "--cant", "1:40", "--gauges-mm", "1430:1440:2", "--report", this.path("geometry.html")]);
    this.treadmark(["convert", "S1002", wheel]);
    this.treadmark(["measure", "wheel", wheel, "--nominal", "S1002", "--report", this.path("measure.html")]);
    this.treadmark(["check", join(this.examples, "wheel-flat.toml"), "--report", this.path("check.html")]);
    this.treadmark(["assess", this.path("simulation"), "--report", this.path("assessment.html")]);
    const limits = this.path("limits.toml");
    writeFileSync(limits, "[wheel]\nflange_height_mm = { min = 29 }\n");
    this.treadmark(["measure", "wheel", wheel, "S1002", "--nominal", "S1002", "--limits", limits, "--report", this.path("fleet.html")], [0, 1]);
    this.treadmark(["track", join(this.examples, "tracks", "gm-tt0088.toml"), "--report", this.path("track.html")]);
    this.treadmark(["stability", join(this.examples, "curve.toml"), "--count", "4", "-o", this.path("stability")]);
    this.treadmark(["report", this.path("stability"), "-o", this.path("stability.html")]);
    return ["geometry", "measure", "check", "assessment", "fleet", "track", "stability"];
  }

  sweep() {
    this.input("swept.toml", "wheel-flat.toml", [["wheelset.pitch_deg = [-14, -10, -8, -6, -4, -2, 0, 2, 4, 6, 8, 10, 14]", "wheelset.pitch_deg = [-3, 0, 3]"], ["dx_mm = 0.5", "dx_mm = 1"]]);
    const study = join(this.examples, "study.toml");
    writeFileSync(study, `[study]\ntitle = "Loads and depths"\nbase = "swept.toml"\n
[[study.vary]]\nkey = "wheelset.vertical_force_N"\nlabel = "load [N]"\nvalues = [60e3, 80e3, 100e3]\n
[[study.vary]]\nkey = "wheel.flats.0.depth_mm"\nvalues = [0.7, 1.4]\n`);
    this.treadmark(["sweep", study, "-o", this.path("sweep"), "--report", this.path("sweep.html")]);
    return "sweep.html";
  }

  /** A flat that wears and flows, and a tread that becomes hollow. */
  evolutions() {
    const places = readFileSync(join(this.examples, "flowing-flat.toml"), "utf8").match(/wheelset\.pitch_deg = \[.*\]/)[0];
    const flat = this.input("worn-flat.toml", "flowing-flat.toml", [
      ["max_depth_mm = 0.03\nmax_pressure_change = 0.25\nsmallest_step = 0.001", "updates = 3"],
      [places, "wheelset.pitch_deg = [-6, -5, -4.25, -3.75, -3, -2, -1, 0, 1, 2, 3, 3.75, 4.25, 5, 6]"],
    ]);
    this.treadmark(["evolve", flat, "-o", this.path("worn-flat"), "--report", this.path("worn-flat.html"), "--set", "evolve.distance_km=0.05"], [0, 1]);
    const tread = this.input("worn-tread.toml", "hollow-wheel.toml", []);
    this.treadmark(["evolve", tread, "-o", this.path("worn-tread"), "--report", this.path("worn-tread.html"), "--set", "evolve.distance_km=5000"]);
    return ["worn-flat.html", "worn-tread.html"];
  }

}
