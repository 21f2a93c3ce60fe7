#error "The component 'session_state' is not selected: add `components: [+session_state]` to microros.yaml and generate again"
