import "./protocol.ts";
