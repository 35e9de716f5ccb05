// Bullet's deformable bodies on a model that peer_own has written as text.
//
//   peer_bullet MODEL --span T --samples N [--frames FILE] [dt=S] [implicit=0|1]
//
// Tetrahedra carry its Neo-Hookean law, which is that of Smith et al. (2018), as is our stable_neo_hookean; it is given the
// constants that make them the same. Masses are our lumped ones. A thread becomes its rope: nodes on the axis and springs
// between them. States are written with the nodes of MODEL, those of a thread at the place of their frame.
#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletSoftBody/btDeformableBodySolver.h>
#include <BulletSoftBody/btDeformableGravityForce.h>
#include <BulletSoftBody/btDeformableMassSpringForce.h>
#include <BulletSoftBody/btDeformableMultiBodyConstraintSolver.h>
#include <BulletSoftBody/btDeformableMultiBodyDynamicsWorld.h>
#include <BulletSoftBody/btDeformableNeoHookeanForce.h>
#include <BulletSoftBody/btSoftBodyHelpers.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <btBulletDynamicsCommon.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace {

struct Model {
	double gravity[3] = {0, 0, 0};
	double density = 0, young = 0, poisson = 0;                               // of a solid
	double stiffness = 0, radius = 0, damping = 0, axis[3] = {0, 0, 0};       // of a thread
	std::vector<double> x, v, mass;                                           // 3, 3 and 1 a node
	std::vector<char> held;                                                   // a node
	std::vector<int> tetrahedra;                                              // 4 a cell
	std::vector<double> planes;                                               // 6 an obstacle
	bool isThread() const { return stiffness > 0; }
};

bool readModel(const char* path, Model& model) {
	std::ifstream file(path);
	std::string line, word;
	while (std::getline(file, line)) {
		std::istringstream in(line);
		in >> word;
		std::vector<double> a;
		for (double value; in >> value;) a.push_back(value);
		if (word == "gravity") std::copy(a.begin(), a.end(), model.gravity);
		if (word == "material") model.density = a[0], model.young = a[1], model.poisson = a[2];
		if (word == "thread") {
			model.stiffness = a[0], model.density = a[1], model.radius = a[2], model.damping = a[3];
			std::copy(a.begin() + 4, a.end(), model.axis);
		}
		if (word == "plane") model.planes.insert(model.planes.end(), a.begin(), a.end());
		if (word == "tet4") model.tetrahedra.insert(model.tetrahedra.end(), a.begin(), a.end());
		if (word == "node") {
			model.x.insert(model.x.end(), a.begin(), a.begin() + 3);
			model.v.insert(model.v.end(), a.begin() + 3, a.begin() + 6);
			model.mass.push_back(a[6]);
			model.held.push_back(0);
		}
		if (word == "held") model.held[size_t(a[0]) / 3] = 1;
	}
	return !model.x.empty() && (model.isThread() || !model.tetrahedra.empty());
}

btVector3 vectorOf(const double* a) {
	return btVector3(btScalar(a[0]), btScalar(a[1]), btScalar(a[2]));
}

// What Bullet's examples of deformable bodies set up.
struct World {
	btSoftBodyRigidBodyCollisionConfiguration configuration;
	btCollisionDispatcher dispatcher{&configuration};
	btDbvtBroadphase broadphase;
	btDeformableBodySolver deformable;
	btDeformableMultiBodyConstraintSolver constraints;
	std::unique_ptr<btDeformableMultiBodyDynamicsWorld> world;
	std::unique_ptr<btDeformableLagrangianForce> gravity, elastic;
	std::unique_ptr<btCollisionShape> floorShape;
	std::unique_ptr<btRigidBody> floor;
	btSoftBody* body = nullptr;

	explicit World(const btVector3& g) {
		constraints.setDeformableSolver(&deformable);
		world = std::make_unique<btDeformableMultiBodyDynamicsWorld>(&dispatcher, &broadphase, &constraints, &configuration,
																	 &deformable);
		btSoftBodyWorldInfo& info = world->getWorldInfo();
		info.m_gravity = g;
		info.air_density = 0;
		info.m_sparsesdf.setDefaultVoxelsz(btScalar(0.25));
		info.m_sparsesdf.Reset();
		world->setGravity(g);
		gravity = std::make_unique<btDeformableGravityForce>(g);
	}
};

// As btSoftBodyHelpers::CreateFromVtkFile does with a file.
btSoftBody* makeSolid(World& w, const Model& model) {
	std::vector<btVector3> x;
	for (size_t i = 0; i < model.mass.size(); ++i) x.push_back(vectorOf(&model.x[3 * i]));
	btSoftBody* body = new btSoftBody(&w.world->getWorldInfo(), int(x.size()), x.data(), nullptr);
	for (size_t c = 0; c < model.tetrahedra.size(); c += 4) {
		const int* n = &model.tetrahedra[c];
		body->appendTetra(n[0], n[1], n[2], n[3]);
		for (int a = 0; a < 4; ++a)
			for (int b = a + 1; b < 4; ++b) body->appendLink(n[a], n[b], nullptr, true);
	}
	btSoftBodyHelpers::generateBoundaryFaces(body);
	body->initializeDmInverse();
	body->m_tetraScratches.resize(body->m_tetras.size());
	body->m_tetraScratchesTn.resize(body->m_tetras.size());
	const double mu = model.young / (2 * (1 + model.poisson));
	const double lambda = model.young * model.poisson / ((1 + model.poisson) * (1 - 2 * model.poisson));
	w.elastic = std::make_unique<btDeformableNeoHookeanForce>(btScalar(4.0 / 3.0 * mu), btScalar(lambda + 5.0 / 6.0 * mu),
															  btScalar(0));
	return body;
}

btVector3 axisPoint(const Model& model, size_t frame) {
	btVector3 p(0, 0, 0);
	for (size_t k = 0; k < 3; ++k) p += btScalar(model.axis[k]) * vectorOf(&model.x[3 * (3 * frame + k)]);
	return p;
}

btSoftBody* makeRope(World& w, const Model& model) {
	const size_t frames = model.mass.size() / 3;
	const btVector3 from = axisPoint(model, 0), to = axisPoint(model, frames - 1);
	btSoftBody* body = btSoftBodyHelpers::CreateRope(w.world->getWorldInfo(), from, to, int(frames) - 2, 0);
	const double pi = 3.14159265358979323846, link = (to - from).length() / double(frames - 1);
	const double k = model.stiffness * pi * model.radius * model.radius / link;
	w.elastic = std::make_unique<btDeformableMassSpringForce>(btScalar(k), btScalar(k * model.damping), true, 0);
	return body;
}

void setUpBody(World& w, const Model& model) {
	btSoftBody* body = w.body = model.isThread() ? makeRope(w, model) : makeSolid(w, model);
	const size_t share = model.isThread() ? 3 : 1;
	for (int i = 0; i < body->m_nodes.size(); ++i) {
		double mass = 0;
		for (size_t k = 0; k < share; ++k) mass += model.mass[share * size_t(i) + k];
		body->setMass(i, model.held[share * size_t(i)] ? 0 : btScalar(mass));
		body->m_nodes[i].m_v = body->m_nodes[i].m_vn = vectorOf(&model.v[3 * share * size_t(i)]);
	}
	body->getCollisionShape()->setMargin(btScalar(0.002));
	body->m_cfg.kKHR = 1;
	body->m_cfg.kCHR = 1;
	body->m_cfg.kDF = 0;
	body->m_cfg.collisions = model.planes.empty() ? 0 : btSoftBody::fCollision::SDF_RD | btSoftBody::fCollision::SDF_RDN;
	body->m_sleepingThreshold = 0;
	body->setActivationState(DISABLE_DEACTIVATION);
	w.world->addSoftBody(body);
	w.world->addForce(body, w.elastic.get());
	w.world->addForce(body, w.gravity.get());
}

// A plane whose normal is y, as a large box below it.
void setUpFloor(World& w, const Model& model) {
	if (model.planes.empty()) return;
	w.floorShape = std::make_unique<btBoxShape>(btVector3(50, 5, 50));
	btTransform place;
	place.setIdentity();
	place.setOrigin(btVector3(btScalar(model.planes[0]), btScalar(model.planes[1] - 5), btScalar(model.planes[2])));
	btRigidBody::btRigidBodyConstructionInfo info(0, nullptr, w.floorShape.get());
	w.floor = std::make_unique<btRigidBody>(info);
	w.floor->setWorldTransform(place);
	w.floor->setFriction(0);
	w.floor->setRestitution(0);
	w.world->addRigidBody(w.floor.get());
}

double seconds() {
	timespec now;
	clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
	return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

void writeState(FILE* file, const World& w, const Model& model, double t) {
	const size_t share = model.isThread() ? 3 : 1;
	std::vector<double> x, v;
	for (int i = 0; i < w.body->m_nodes.size(); ++i)
		for (size_t k = 0; k < share; ++k)
			for (int axis = 0; axis < 3; ++axis) {
				x.push_back(double(w.body->m_nodes[i].m_x[axis]));
				v.push_back(double(w.body->m_nodes[i].m_v[axis]));
			}
	std::fwrite(&t, sizeof t, 1, file);
	std::fwrite(x.data(), sizeof(double), x.size(), file);
	std::fwrite(v.data(), sizeof(double), v.size(), file);
}

// Has a node left the neighbourhood, as it does in unstable steps?
bool isLost(const World& w) {
	for (int i = 0; i < w.body->m_nodes.size(); ++i)
		if (!(w.body->m_nodes[i].m_x.length2() < 1e4)) {
			std::fprintf(stderr, "unstable: a node is more than 100 m away\n");
			return true;
		}
	return false;
}

struct Options {
	double span = 1, dt = 5e-3;
	int samples = 1, implicit = 1;
	const char* frames = nullptr;
};

bool readOptions(int count, char** words, Options& o) {
	for (int i = 2; i < count; ++i) {
		const std::string word = words[i];
		const char* next = i + 1 < count ? words[i + 1] : nullptr;
		if (word.compare(0, 2, "--") == 0 && next == nullptr) return false;
		if (word == "--span") o.span = std::atof(words[++i]);
		else if (word == "--samples") o.samples = std::atoi(words[++i]);
		else if (word == "--frames") o.frames = words[++i];
		else if (word.compare(0, 3, "dt=") == 0) o.dt = std::atof(word.c_str() + 3);
		else if (word.compare(0, 9, "implicit=") == 0) o.implicit = std::atoi(word.c_str() + 9);
		else return false;
	}
	return o.samples > 0 && o.dt > 0;
}

int run(const Model& model, const Options& o) {
	World w(vectorOf(model.gravity));
	setUpBody(w, model);
	setUpFloor(w, model);
	w.world->setImplicit(o.implicit != 0);
	w.world->setLineSearch(false);
	w.world->setUseProjection(true); // without it the implicit scheme does not move
	FILE* file = o.frames != nullptr ? std::fopen(o.frames, "wb") : nullptr;
	double taken = 0;
	const long steps = long(o.span / o.samples / o.dt + 0.5); // between states
	for (int k = 1; k <= o.samples; ++k) {
		const double start = seconds();
		for (long i = 0; i < steps; ++i) {
			w.world->stepSimulation(btScalar(o.dt), 0);
			if (isLost(w)) return 1;
		}
		taken += seconds() - start;
		if (file != nullptr) writeState(file, w, model, o.span * k / o.samples);
	}
	if (file != nullptr) std::fclose(file);
	std::printf("steps %ld\nseconds %.9g\n", steps * o.samples, taken);
	if (w.floor) w.world->removeRigidBody(w.floor.get());
	w.world->removeSoftBody(w.body);
	delete w.body;
	return 0;
}

} // namespace

int main(int count, char** words) {
	Model model;
	Options options;
	if (count < 2 || !readModel(words[1], model) || !readOptions(count, words, options)) {
		std::fprintf(stderr, "usage: peer_bullet MODEL --span T --samples N [--frames FILE] [dt=S] [implicit=0|1]\n");
		return 1;
	}
	return run(model, options);
}
