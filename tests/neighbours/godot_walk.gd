# SPDX-License-Identifier: GPL-3.0-or-later
# Run by Godot's server (version 3): walks.json says what to load and where a body walks; answer.json says where it got to.
extends SceneTree

const STEPS_A_SECOND = 60

var tasks = []
var answer = []
var scene = null
var body = null
var walk = 0
var steps = 0
var floor_steps = 0
var begun = false


func _init():
	tasks = JSON.parse(text_of("res://walks.json")).result
	load_next()


func text_of(path):
	var file = File.new()
	file.open(path, File.READ)
	return file.get_as_text()


func load_next():
	if scene != null:
		root.remove_child(scene)
		scene.free()
		scene = null
	if answer.size() == tasks.size():
		var file = File.new()
		file.open("res://answer.json", File.WRITE)
		file.store_string(JSON.print(answer))
		file.close()
		quit(0)
		return
	var packed = load("res://" + tasks[answer.size()].scene)
	if packed == null:
		printerr("not imported: ", tasks[answer.size()].scene)
		quit(1)
		return
	scene = packed.instance()
	var counts = {}
	prepare(scene, tasks[answer.size()].margin_m, counts)
	root.add_child(scene)
	answer.append({"scene": tasks[answer.size()].scene, "nodes": counts, "walks": []})
	walk = 0
	begin()


# Counts nodes by class; shapes get the margin, by which Godot's Bullet makes each of them larger.
func prepare(node, margin_m, counts):
	var kind = node.get_class()
	counts[kind] = counts.get(kind, 0) + 1
	if node is CollisionShape:
		node.shape.margin = margin_m
	for child in node.get_children():
		prepare(child, margin_m, counts)


func vector(numbers):
	return Vector3(numbers[0], numbers[1], numbers[2])


# A capsule's axis is Z in Godot 3, and its height is that of the cylinder alone.
func begin():
	var task = tasks[answer.size() - 1]
	var capsule = CapsuleShape.new()
	capsule.radius = task.radius_m
	capsule.height = task.height_m - 2 * task.radius_m
	var shape = CollisionShape.new()
	shape.shape = capsule
	shape.transform = Transform(Basis(Vector3.RIGHT, PI / 2), Vector3(0, task.height_m / 2, 0))
	body = KinematicBody.new()
	body.add_child(shape)
	body.transform.origin = vector(task.walks[walk].from)
	scene.add_child(body)
	steps = 0
	floor_steps = 0


# One step: ahead at the stated speed, down by gravity; true once the body is level with the end or time is over.
func step():
	var task = tasks[answer.size() - 1]
	var way = vector(task.walks[walk].to) - vector(task.walks[walk].from)
	way.y = 0
	var ahead = way.normalized()
	var fall = -9.81 / STEPS_A_SECOND
	var moved = body.move_and_slide(ahead * task.speed_m_s + Vector3(0, fall, 0), Vector3.UP, true)
	if body.is_on_floor():
		floor_steps += 1
	steps += 1
	var gone = body.transform.origin - vector(task.walks[walk].from)
	return gone.dot(ahead) >= way.length() or steps >= task.most_steps


# In the first iteration a step still lasts a second for Godot.
func _iteration(_delta):
	if not begun:
		begun = true
		return false
	if body == null:
		return false
	if not step():
		return false
	var at = body.transform.origin
	answer[-1].walks.append({"at": [at.x, at.y, at.z], "steps": steps, "steps_on_floor": floor_steps})
	scene.remove_child(body)
	body.free()
	body = null
	walk += 1
	if walk < tasks[answer.size() - 1].walks.size():
		begin()
	else:
		load_next()
	return false
