// placeholder
export class Lessons { constructor() {} }
