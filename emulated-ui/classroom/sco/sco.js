// SPDX-License-Identifier: GPL-3.0-or-later
// The page of a SCORM 1.2 package: takes a signed file, checks it against ASSIGNMENT (assignment.js), and reports the
// mark to the learning management system. Signatures and hashes are those of nacl (tweetnacl), which works on plain
// http, too.
"use strict";
(function () {
  const RESULT = "standpoint-result-1", MARK = "standpoint-mark-1";
  const LONGEST = 16 * 1024 * 1024;

  const WORDS = {
    en: {
      goal: "Hand in the result of this exercise.",
      goal_graded: "Hand in the mark that your lecturer gave you for this exercise.",
      ask: "Drop the file here, or choose it:",
      promise: "The file is read in your browser; only the mark is sent.",
      no_lms: "This page was opened outside of a course: a file is checked, but nothing is reported.",
      taken: "Accepted: {score} %, {verdict}.",
      passed: "passed", failed: "not passed",
      large: "The file is too large for a result.",
      form: "This is not a file that Standpoint wrote for handing in.",
      signature: "The file was changed after it was signed.",
      lecturer: "This mark was not signed by your lecturer.",
      assignment: "This file belongs to another exercise or to another class.",
      student: "This is the file of another student.",
      unknown: "Your user name is not in the class list of this exercise; ask your lecturer.",
      variant: "This file answers another variant than yours.",
      chain: "The record of actions was changed at action {action}.",
      late: "The deadline has passed: {deadline}.",
      mark: "The mark in the file is not possible.",
      not_kept: "The course did not accept the mark (error {error})."
    },
    de: {
      goal: "Geben Sie das Ergebnis dieser Übung ab.",
      goal_graded: "Geben Sie die Note ab, die Sie für diese Übung bekommen haben.",
      ask: "Datei hierher ziehen oder auswählen:",
      promise: "Die Datei wird in Ihrem Browser gelesen; gesendet wird nur die Note.",
      no_lms: "Diese Seite wurde außerhalb eines Kurses geöffnet: Eine Datei wird geprüft, aber nichts gemeldet.",
      taken: "Angenommen: {score} %, {verdict}.",
      passed: "bestanden", failed: "nicht bestanden",
      large: "Die Datei ist zu groß für ein Ergebnis.",
      form: "Das ist keine Datei, die Standpoint zum Abgeben geschrieben hat.",
      signature: "Die Datei wurde nach dem Signieren geändert.",
      lecturer: "Diese Note hat nicht Ihre Lehrperson signiert.",
      assignment: "Diese Datei gehört zu einer anderen Übung oder zu einer anderen Klasse.",
      student: "Das ist die Datei einer anderen Person.",
      unknown: "Ihr Benutzername steht nicht in der Klassenliste dieser Übung; fragen Sie Ihre Lehrperson.",
      variant: "Diese Datei löst eine andere Variante als Ihre.",
      chain: "Die Aufzeichnung wurde bei Handlung {action} geändert.",
      late: "Die Abgabefrist ist vorbei: {deadline}.",
      mark: "Die Note in der Datei ist nicht möglich.",
      not_kept: "Der Kurs hat die Note nicht angenommen (Fehler {error})."
    },
    uk: {
      goal: "Здайте результат цієї вправи.",
      goal_graded: "Здайте оцінку, яку ви отримали за цю вправу.",
      ask: "Перетягніть файл сюди або виберіть його:",
      promise: "Файл читається у вашому браузері; надсилається лише оцінка.",
      no_lms: "Сторінку відкрито поза курсом: файл буде перевірено, але нічого не надіслано.",
      taken: "Прийнято: {score} %, {verdict}.",
      passed: "складено", failed: "не складено",
      large: "Файл завеликий для результату.",
      form: "Це не файл, який Standpoint записав для здавання.",
      signature: "Файл змінено після підписання.",
      lecturer: "Цю оцінку підписав не ваш викладач.",
      assignment: "Цей файл належить до іншої вправи або до іншої групи.",
      student: "Це файл іншого студента.",
      unknown: "Вашого імені користувача немає в списку групи цієї вправи; зверніться до викладача.",
      variant: "Цей файл розв’язує інший варіант, а не ваш.",
      chain: "Запис дій змінено на дії {action}.",
      late: "Термін минув: {deadline}.",
      mark: "Такої оцінки у файлі бути не може.",
      not_kept: "Курс не прийняв оцінку (помилка {error})."
    }
  };

  const spoken = (navigator.language || "en").slice(0, 2);
  const language = WORDS[spoken] ? spoken : "en";
  function word(key, places) {
    return WORDS[language][key].replace(/\{(\w+)\}/g, (all, name) => places[name]);
  }

  // --- the learning management system ---

  // On this window, those around it, and those that opened it; a window of another origin may not be asked.
  function findApi(from) {
    for (let w = from, n = 0; w && n < 20; n += 1) {
      try {
        if (w.API) return w.API;
      } catch (otherOrigin) {
        return null;
      }
      if (w.parent === w) break;
      w = w.parent;
    }
    return null;
  }
  function anyApi() {
    let opener = null;
    try {
      opener = window.opener || window.top.opener;
    } catch (otherOrigin) {
      opener = null;
    }
    return findApi(window) || (opener ? findApi(opener) : null);
  }

  const api = anyApi();
  const began = Date.now();
  let connected = api !== null && String(api.LMSInitialize("")) === "true";

  function finish() {
    if (!connected) return;
    connected = false;
    const s = (Date.now() - began) / 1000, pad = (n, width) => String(n).padStart(width, "0");
    const hours = Math.min(9999, Math.floor(s / 3600));
    api.LMSSetValue("cmi.core.session_time",
                    pad(hours, 4) + ":" + pad(Math.floor(s / 60) % 60, 2) + ":" + pad(Math.floor(s) % 60, 2) + "." +
                        pad(Math.floor(s * 100) % 100, 2));
    api.LMSCommit("");
    api.LMSFinish("");
  }
  window.addEventListener("pagehide", finish);

  function Refused(key, places) {
    this.key = key;
    this.places = places || {};
  }

  function put(name, value) {
    if (String(api.LMSSetValue(name, value)) !== "true")
      throw new Refused("not_kept", {error: api.LMSGetLastError()});
  }

  // --- checks ---

  const bytes = (text) => new Uint8Array(new TextEncoder().encode(text));
  function fromBase64(text) {
    const raw = atob(text), out = new Uint8Array(raw.length);
    for (let i = 0; i < raw.length; i += 1) out[i] = raw.charCodeAt(i);
    return out;
  }
  function digest(text) {
    return Array.from(nacl.hash(bytes(text)).slice(0, 32), (b) => b.toString(16).padStart(2, "0")).join("");
  }
  const personHash = (name) => digest("standpoint student\n" + ASSIGNMENT.salt + "\n" + name).slice(0, 24);

  function isSigned(seal) {
    try {
      return nacl.sign.detached.verify(bytes(seal.format + "\n" + seal.payload), fromBase64(seal.signature),
                                       fromBase64(seal.key));
    } catch (malformed) {
      return false;
    }
  }

  function opened(text) {
    let seal, content;
    try {
      seal = JSON.parse(text);
      if (seal.format !== (ASSIGNMENT.graded ? MARK : RESULT)) throw new Refused("form");
      content = JSON.parse(seal.payload);
    } catch (malformed) {
      throw new Refused("form");
    }
    if (!isSigned(seal)) throw new Refused("signature");
    if (ASSIGNMENT.graded && seal.key !== ASSIGNMENT.key) throw new Refused("lecturer");
    return content;
  }

  function checkChain(r) {
    let link = digest([RESULT, r.assignment_hash, r.exercise_hash, r.model, r.program, r.student, r.seed].join("\n"));
    r.actions.forEach((a, i) => {
      link = digest([link, a.action, a.ms, a.state].join("\n"));
      if (link !== a.hash) throw new Refused("chain", {action: i + 1});
    });
    if (link !== r.head) throw new Refused("chain", {action: r.actions.length + 1});
  }

  function check(r) {
    if (r.assignment_hash !== ASSIGNMENT.hash || r.exercise !== ASSIGNMENT.exercise) throw new Refused("assignment");
    const given = Object.prototype.hasOwnProperty;
    if (connected) {
      const me = personHash(api.LMSGetValue("cmi.core.student_id"));
      if (!given.call(ASSIGNMENT.people, me)) throw new Refused("unknown");
      if (ASSIGNMENT.people[me].student !== personHash(r.student)) throw new Refused("student");
      if (ASSIGNMENT.people[me].seed !== r.seed) throw new Refused("variant");
    }
    if (!ASSIGNMENT.graded) checkChain(r);
    if (!ASSIGNMENT.graded && ASSIGNMENT.deadline && r.finished > ASSIGNMENT.deadline)
      throw new Refused("late", {deadline: new Date(ASSIGNMENT.deadline).toLocaleString()});
    if (!(r.score >= 0 && r.score <= 1)) throw new Refused("mark");
  }

  // --- the report ---

  // Printable ASCII without blanks, as SCORM's identifiers must be.
  const identifier = (text) => text.replace(/[^A-Za-z0-9_-]/g, "_");

  function send(r) {
    const before = Number(api.LMSGetValue("cmi.interactions._count")) || 0;
    put("cmi.core.score.min", "0");
    put("cmi.core.score.max", "100");
    put("cmi.core.score.raw", String(Math.round(r.score * 10000) / 100));
    put("cmi.core.lesson_status", r.passed === true ? "passed" : "failed");
    put("cmi.suspend_data", JSON.stringify({seed: r.seed, head: r.head}));
    r.criteria.filter((c) => c.kind === "rule").forEach((c, i) => {
      const at = "cmi.interactions." + (before + i) + ".";
      put(at + "id", identifier(c.id));
      put(at + "type", "performance");
      put(at + "result", c.held === true ? "correct" : "wrong");
    });
    if (String(api.LMSCommit("")) !== "true") throw new Refused("not_kept", {error: api.LMSGetLastError()});
  }

  function say(text, kind) {
    const said = document.getElementById("said");
    said.textContent = text;
    said.className = kind;
  }

  // True where the file was accepted.
  function report(text) {
    try {
      const r = opened(text);
      check(r);
      if (connected) send(r);
      say(word("taken", {score: Math.round(r.score * 1000) / 10, verdict: word(r.passed === true ? "passed" : "failed")}) +
              (connected ? "" : "\n" + word("no_lms")), "yes");
      return true;
    } catch (problem) {
      if (!(problem instanceof Refused)) problem = new Refused("form");
      say(word(problem.key, problem.places), "no");
      return false;
    }
  }
  window.report = report;

  async function take(file) {
    if (!file) return;
    if (file.size > LONGEST) say(word("large"), "no");
    else report(await file.text());
  }

  const drop = document.getElementById("drop"), input = document.getElementById("file");
  input.addEventListener("change", () => take(input.files[0]));
  ["dragover", "dragleave", "drop"].forEach((name) => drop.addEventListener(name, (event) => {
    event.preventDefault();
    drop.className = name === "dragover" ? "over" : "";
    if (name === "drop") take(event.dataTransfer.files[0]);
  }));

  document.documentElement.lang = language;
  document.getElementById("title").textContent =
      ASSIGNMENT.exercise + " · " + (ASSIGNMENT.title[language] || ASSIGNMENT.title.en);
  document.title = document.getElementById("title").textContent;
  document.getElementById("goal").textContent = word(ASSIGNMENT.graded ? "goal_graded" : "goal");
  document.getElementById("ask").textContent = word("ask");
  document.getElementById("promise").textContent = word("promise");
  if (!connected) say(word("no_lms"), "");
})();
