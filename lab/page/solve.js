// Asks the core: at once on the main thread, or in a worker with one question in progress and the newest waiting.

/** Time limit (ms) of a worker's start, most failed starts, and number of failures in a row after which it is not
 * started again. */
const START = 30000, STARTS = 2, FAILURES = 5;

/** An answer of the core; a failure without a message gets one. */
function read(text) {
  const answer = JSON.parse(text);
  return answer.panic ? { ...answer, error: answer.error || "The core stopped." } : answer;
}

/** The core of the main thread, for answers within a frame. A spare one is ready in case it fails. */
export class Near {
  /** @param {WebAssembly.Module} module */
  static async of(module) {
    const near = new Near();
    // Browsers compile a large module on the main thread only asynchronously.
    near.fresh = async () => (await WebAssembly.instantiate(module, {})).exports;
    [near.core, near.spare] = [await near.fresh(), await near.fresh()];
    return near;
  }

  /** The answer to a question. */
  ask(question) {
    const { core } = this, bytes = new TextEncoder().encode(JSON.stringify({ id: 0, ...question }));
    if (!core) return { id: 0, error: "The core is starting again; try once more." };
    const at = core.room(bytes.length);
    new Uint8Array(core.memory.buffer, at, bytes.length).set(bytes);
    let length;
    try {
      length = core.answer();
    } catch {
      // The answer to an empty question is the message of the failure; this core is not used again.
      core.room(0);
      length = core.answer();
      [this.core, this.spare] = [this.spare, null];
      this.fresh().then((exports) => { if (this.core) this.spare = exports; else this.core = exports; });
    }
    return read(new TextDecoder().decode(new Uint8Array(core.memory.buffer, core.answer_at(), length)));
  }
}

/**
 * @typedef {object} Waiting
 * @property {number} id
 * @property {string} kind
 * @property {object} question
 * @property {Uint8Array} [bytes] of a picture, after the question
 * @property {(answer: object | null) => void} then called with null if a newer question replaced this one
 */

/** A worker that answers one question at a time. Of every kind the newest waits, and older ones are dropped. */
export class Far {
  /**
   * @param {WebAssembly.Module} module
   * @param {string} program text of worker.js
   * @param {number} limit ms after which an answer is given up
   */
  constructor(module, program, limit) {
    Object.assign(this, { module, program, limit, count: 0, under: null, ready: false, starts: 0, failures: 0, dead: null });
    /** @type {Map<string, Waiting>} */
    this.waiting = new Map();
    /** For tests: delay of an answer (ms). */
    this.delay = 0;
    this.begin();
  }

  begin() {
    const address = URL.createObjectURL(new Blob([this.program], { type: "text/javascript" }));
    this.worker = new Worker(address);
    URL.revokeObjectURL(address);
    this.ready = false;
    this.starts += 1;
    this.clock = setTimeout(() => this.stuck(), START);
    const { worker } = this;
    worker.onmessage = ({ data }) => {
      if (worker !== this.worker) return;
      if (data.ready) {
        clearTimeout(this.clock);
        Object.assign(this, { ready: true, starts: 0 });
        this.next();
      } else if (data.failed) {
        this.stuck();
      } else if (this.delay > 0) {
        setTimeout(() => worker === this.worker && this.came(data), this.delay);
      } else {
        this.came(data);
      }
    };
    worker.onerror = () => {
      if (worker !== this.worker) return;
      if (this.ready) this.failed("The core could not go on."); else this.stuck();
    };
    worker.postMessage({ module: this.module });
  }

  /** The worker did not start: it is started again, or every question is answered with this message. */
  stuck() {
    clearTimeout(this.clock);
    if (this.starts < STARTS) this.anew();
    else this.die("The core does not start in this browser; load the page again.");
  }

  /** Answers every question from now on with this message. */
  die(words) {
    this.close();
    this.dead = words;
    for (const { id, then } of this.waiting.values()) then({ id, error: words });
    this.waiting.clear();
  }

  /** Ends the worker for good. */
  close() {
    clearTimeout(this.clock);
    this.worker.terminate();
  }

  /** The present question failed by an internal error; after several in a row the page gives up. */
  failed(words) {
    this.failures += 1;
    if (this.failures < FAILURES) { this.end(words, { panic: true }); return; }
    const { under } = this;
    this.under = null;
    this.die(`The core failed ${FAILURES} times in a row, so it is not asked again; keep the bat file and load the page again.`);
    under?.then({ id: under.id, error: words, panic: true });
  }

  /**
   * Asks and returns the answer; null if a newer question of its kind replaced it.
   * @returns {Promise<any>}
   */
  ask(question, kind = question.ask, bytes) {
    this.count += 1;
    const id = this.count;
    if (this.dead) return Promise.resolve({ id, error: this.dead });
    return new Promise((then) => {
      this.waiting.get(kind)?.then(null);
      this.waiting.delete(kind);
      this.waiting.set(kind, { id, kind, question: { ...question, id }, bytes, then });
      this.next();
    });
  }

  next() {
    if (this.under || !this.ready || this.waiting.size === 0) return;
    const [kind, first] = this.waiting.entries().next().value;
    this.waiting.delete(kind);
    this.under = first;
    this.worker.postMessage({ text: JSON.stringify(first.question), bytes: first.bytes });
    this.clock = setTimeout(() => this.end(
      `No answer within ${this.limit / 1000} s, so the calculation was ended. Change the bat and it is tried again.`,
    ), this.limit);
  }

  came({ text, took }) {
    const answer = read(text);
    if (answer.panic) { this.failed(answer.error); return; }
    clearTimeout(this.clock);
    const { under } = this;
    Object.assign(this, { under: null, failures: 0 });
    under?.then({ ...answer, id: under.id, took });
    this.next();
  }

  /** A new worker from the compiled module, which takes the waiting questions. */
  anew() {
    this.worker.terminate();
    this.begin();
  }

  /** Ends the present question with this message; the waiting ones continue in a new worker. */
  end(words, more = {}) {
    clearTimeout(this.clock);
    const { under } = this;
    this.under = null;
    this.anew();
    under?.then(words ? { id: under.id, error: words, ...more } : null);
  }

  /** Drops the questions of such kinds. */
  drop(such) {
    for (const { kind, then } of [...this.waiting.values()].filter((one) => such(one.kind))) {
      this.waiting.delete(kind);
      then(null);
    }
    if (this.under && such(this.under.kind)) this.end(null);
  }
}

/** The compiled core from the page's own text. */
export async function compiled(letters) {
  const bytes = Uint8Array.from(atob(letters.trim()), (letter) => letter.charCodeAt(0));
  const plain = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return WebAssembly.compile(await new Response(plain).arrayBuffer());
}
