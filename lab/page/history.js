// Keeps all bats so far, so that every step can be undone and redone without limit.

/** Steps of undo: whole bat files as text, and the index of the one shown. */
export class History {
  /** @param {string} first */
  constructor(first) {
    /** @type {string[]} */
    this.steps = [first];
    this.place = 0;
    /** The places of the bats that were opened. */
    this.openings = [0];
  }

  get now() { return this.steps[this.place]; }
  /** The bat as it was opened: the default for comparisons. */
  get opened() { return this.steps[this.openings.findLast((place) => place <= this.place)]; }
  get before() { return this.place > 0 ? this.steps[this.place - 1] : null; }
  get canUndo() { return this.place > 0; }
  get canRedo() { return this.place < this.steps.length - 1; }

  /** Adds a step and drops the undone ones. A step without a change is ignored. */
  push(text) {
    if (text === this.now) return false;
    this.steps.length = this.place + 1;
    this.openings = this.openings.filter((place) => place <= this.place);
    this.steps.push(text);
    this.place += 1;
    return true;
  }

  undo() { if (this.canUndo) this.place -= 1; return this.now; }
  redo() { if (this.canRedo) this.place += 1; return this.now; }

  /** Another bat: an ordinary step, and the new reference of differences. */
  open(text) {
    this.push(text);
    if (!this.openings.includes(this.place)) this.openings.push(this.place);
  }
}
