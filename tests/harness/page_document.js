// As much of a browser's document as the scripts of a page use, in node: they run as they stand in the file, in a
// context with nothing else. Layout, colours and events of a real browser are not here: see test_in_a_browser.
"use strict";
const vm = require("vm");

// Of a busy machine [ms].
const PATIENCE = 20000;
const VOID = new Set(["meta", "link", "input", "br"]);

class Element {
  constructor(tag) {
    Object.assign(this, { tag, attributes: {}, children: [], listeners: {}, style: {}, hidden: false, words: "", value: "" });
    const names = () => (this.attributes.class || "").split(" ").filter(Boolean);
    this.classList = {
      toggle: (name, on) => { this.attributes.class = [...names().filter((one) => one !== name), ...(on ? [name] : [])].join(" "); },
      contains: (name) => names().includes(name),
      add: (name) => this.classList.toggle(name, true),
    };
  }
  setAttribute(name, value) {
    this.attributes[name] = String(value);
    if (name === "hidden") this.hidden = true;
    if (name === "value") this.value = value;
  }
  getAttribute(name) { return name in this.attributes ? this.attributes[name] : null; }
  get id() { return this.attributes.id || ""; }
  set id(value) { this.attributes.id = value; }
  get className() { return this.attributes.class || ""; }
  set className(value) { this.attributes.class = value; }
  get textContent() { return this.words + this.children.map((one) => one.textContent).join(""); }
  set textContent(words) { this.children = []; this.words = String(words); }
  remove() {
    if (this.parentNode) this.parentNode.children = this.parentNode.children.filter((one) => one !== this);
    this.parentNode = null;
  }
  closest(selector) { return this.matches(selector) ? this : this.parentNode ? this.parentNode.closest(selector) : null; }
  // A canvas takes every line and shows none.
  getContext() { return new Proxy({}, { get: () => () => {}, set: () => true }); }
  get dataset() { return { advice: this.attributes["data-advice"] }; }
  get lastChild() { return this.children.at(-1); }
  get tHead() { return this.querySelector("thead"); }
  get tBodies() { return this.querySelectorAll("tbody"); }
  append(...more) {
    for (const one of more) {
      this.children.push(one instanceof Element ? one : Object.assign(new Element("#text"), { words: String(one) }));
      this.lastChild.parentNode = this;
    }
  }
  appendChild(one) { this.append(one); return one; }
  replaceChildren(...more) { this.children = []; this.append(...more); }
  addEventListener(type, listener) { (this.listeners[type] ||= []).push(listener); }
  dispatch(type) { for (const one of this.listeners[type] || []) one({ target: this }); }
  click() { this.dispatch("click"); }
  all() { return this.children.flatMap((one) => [one, ...one.all()]); }
  matches(simple) {
    const [, tag, id, name, key, value] = /^(\w+)?(?:#([\w-]+))?(?:\.([\w-]+))?(?:\[(\w+)='(.*)'\])?$/.exec(simple);
    return (!tag || this.tag === tag) && (!id || this.id === id) && (!name || this.classList.contains(name)) &&
      (!key || this.attributes[key] === value);
  }
  querySelectorAll(selector) {
    return selector.split(" ").reduce((found, simple) =>
      found.flatMap((one) => one.all()).filter((one) => one.matches(simple)), [this]);
  }
  querySelector(selector) { return this.querySelectorAll(selector)[0] || null; }
}

// The tree of a file as this project writes it: attributes in double quotes, all elements closed.
function parsed(html) {
  const root = new Element("#document"), open = [root];
  const pattern = /<(script|style)([^>]*)>([^]*?)<\/\1>|<(\/?)(\w+)([^>]*?)(\/?)>|<!--[^]*?-->|([^<]+)/g;
  for (const [, raw, rawAttributes, code, close, tag, attributes, ended, words] of html.matchAll(pattern)) {
    const parent = open.at(-1);
    if (words !== undefined) { parent.append(words); continue; }
    if (close) {
      if (parent.tag !== tag) throw new Error(`</${tag}> closes <${parent.tag}>`);
      open.pop();
      continue;
    }
    if (!raw && !tag) continue;
    const made = new Element(raw || tag);
    for (const [, name, , value] of (raw ? rawAttributes : attributes).matchAll(/([\w-]+)(="([^"]*)")?/g)) made.setAttribute(name, value ?? "");
    if (raw) made.words = code;
    parent.append(made);
    if ("selected" in made.attributes) parent.value = made.value;
    if (!raw && !ended && !VOID.has(tag)) open.push(made);
  }
  return root;
}

// `unpacks`: of a report, whether the browser can.
// Opens a page: {document, location, errors, asked: what the worker is asked of what lives, when(condition)}; `worker` says whether there can be one.
function opened(html, { hash = "", worker = true, unpacks = null } = {}) {
  const document = parsed(html), location = { hash, pathname: "/page.html", search: "" }, errors = [], blobs = [], steps = [], asked = [];
  document.createElement = (tag) => new Element(tag);
  document.createElementNS = (_, tag) => new Element(tag);
  document.getElementById = (id) => document.all().find((one) => id && one.id === id) || null;
  document.body = document.querySelector("body");
  document.documentElement = document.querySelector("html");
  const guarded = (work) => (...given) => { try { work(...given); } catch (error) { errors.push(error.stack); } };
  const standard = { WebAssembly, TextEncoder, TextDecoder, performance, URLSearchParams, console, atob, Response, DecompressionStream,
    setTimeout: (work, after) => setTimeout(guarded(work), after) };
  class Blob { constructor(parts) { this.text = parts.join(""); } }
  class Worker {
    constructor(address) {
      const scope = { postMessage: (data) => setTimeout(guarded(() => this.onmessage({ data: structuredClone(data) }))) };
      vm.runInNewContext(blobs[address].text.replace("RUNNER.serve(self)", "RUNNER.serve(scope)"), { ...standard, scope });
      this.postMessage = (data) => {
        if (data.live) asked.push(structuredClone(data));
        setTimeout(guarded(() => scope.onmessage({ data: structuredClone(data) })));
      };
    }
  }
  const context = vm.createContext({ ...standard, document, location, Blob,
    history: { pushState: (state, title, address) => { location.hash = address; steps.push(address); } },
    ...(unpacks === null ? {} : { Blob: globalThis.Blob }), ...(unpacks === false ? { DecompressionStream: undefined } : {}),
    URL: { createObjectURL: (blob) => String(blobs.push(blob) - 1), revokeObjectURL() {} },
    matchMedia: () => ({ matches: true }), addEventListener: (type, listener) => document.addEventListener(type, listener),
    requestAnimationFrame: (work) => setTimeout(guarded(() => work(performance.now()))), ...(worker ? { Worker } : {}) });
  for (const script of document.querySelectorAll("script"))
    if (!script.getAttribute("type")) vm.runInContext(script.textContent, context);
  async function when(condition) {
    for (const since = performance.now(); !condition() && !errors.length;) {
      if (performance.now() - since > PATIENCE) throw new Error("not in " + PATIENCE / 1000 + " s: " + condition);
      await new Promise((go) => setTimeout(go, 5));
    }
  }
  return { document, location, errors, blobs, steps, asked, when };
}

module.exports = { opened };
